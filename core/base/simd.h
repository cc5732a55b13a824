#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace pleat {

/// One number, or the compiler's vector of several, which takes the same operators.
template <class Number, int n>
struct LaneNumbers {
  // NOLINTNEXTLINE(modernize-use-using): GCC takes no attribute of a dependent size in "using"
  typedef Number Type __attribute__((vector_size(n * sizeof(Number)), aligned(16)));
};
template <class Number>
struct LaneNumbers<Number, 1> {
  using Type = Number;
};

/// Numbers computed with together, one in each lane. Loads and stores need no alignment.
///
/// Every operation rounds like that of one number, so that all builds, and one lane and four, agree
/// to the bit.
template <class Number, int n>
struct Simd {
  using Real = Number;
  using Value = typename LaneNumbers<Number, n>::Type;
  static constexpr int kLanes = n;
  Value value;

  static Simd load(const Number* from) {
    Simd lanes;
    std::memcpy(&lanes.value, from, sizeof(Value));
    return lanes;
  }
  static Simd all(Number number) { return {number - Value{}}; }
  static Simd gather(const Number* from, const std::array<int, n>& at) {
    return {Value{from[at[0]], from[at[1]], from[at[2]], from[at[3]]}};
  }
  void store(Number* to) const { std::memcpy(to, &value, sizeof(Value)); }
  void scatter(Number* to, const std::array<int, n>& at) const {
    for (std::size_t lane = 0; lane < n; ++lane) to[at[lane]] = value[lane];
  }
};

using Float1 = Simd<float, 1>;
using Float4 = Simd<float, 4>;
using Double4 = Simd<double, 4>;  ///< holds a program against itself without float's rounding

template <class Number, int n>
Simd<Number, n> operator+(Simd<Number, n> a, Simd<Number, n> b) {
  return {a.value + b.value};
}
template <class Number, int n>
Simd<Number, n> operator-(Simd<Number, n> a, Simd<Number, n> b) {
  return {a.value - b.value};
}
template <class Number, int n>
Simd<Number, n> operator*(Simd<Number, n> a, Simd<Number, n> b) {
  return {a.value * b.value};
}
template <class Number, int n>
Simd<Number, n> operator/(Simd<Number, n> a, Simd<Number, n> b) {
  return {a.value / b.value};
}

inline Float1 sqrt(Float1 a) { return {std::sqrt(a.value)}; }
template <class Number>
Simd<Number, 2> sqrt(Simd<Number, 2> a) {
  return {typename Simd<Number, 2>::Value{std::sqrt(a.value[0]), std::sqrt(a.value[1])}};
}
template <class Number>
Simd<Number, 4> sqrt(Simd<Number, 4> a) {
  using Four = typename Simd<Number, 4>::Value;
  return {Four{std::sqrt(a.value[0]), std::sqrt(a.value[1]), std::sqrt(a.value[2]),
               std::sqrt(a.value[3])}};
}

/// The larger of a and b; a when it is not a number, so that an error is not hidden.
template <class Number, int n>
Simd<Number, n> max(Simd<Number, n> a, Simd<Number, n> b) {
  return {a.value < b.value ? b.value : a.value};
}

/// The smaller of a and b; a when it is not a number.
template <class Number, int n>
Simd<Number, n> min(Simd<Number, n> a, Simd<Number, n> b) {
  return {b.value < a.value ? b.value : a.value};
}

/// `a` where `condition` is positive, else zero.
template <class Number, int n>
Simd<Number, n> where_positive(Simd<Number, n> condition, Simd<Number, n> a) {
  const Simd<Number, n> zero{};
  return {condition.value > zero.value ? a.value : zero.value};
}

// One instruction each. Compilers see it in the comparison above, but where an operand is constant
// g++ takes four, and clang 14 loses the sign of a zero.
#if defined(__SSE2__)
inline Float4 max(Float4 a, Float4 b) { return {__builtin_ia32_maxps(b.value, a.value)}; }
inline Float4 min(Float4 a, Float4 b) { return {__builtin_ia32_minps(b.value, a.value)}; }
#elif defined(__wasm_simd128__)
inline Float4 max(Float4 a, Float4 b) { return {__builtin_wasm_pmax_f32x4(a.value, b.value)}; }
inline Float4 min(Float4 a, Float4 b) { return {__builtin_wasm_pmin_f32x4(a.value, b.value)}; }
#endif

/// Bit l is set where lane l is positive.
inline int positive_lanes(Float4 a) {
  const auto is_positive = a.value > Float4::Value{};
#if defined(__SSE2__)
  return __builtin_ia32_movmskps(reinterpret_cast<Float4::Value>(is_positive));
#elif defined(__wasm_simd128__)
  return static_cast<int>(__builtin_wasm_bitmask_i32x4(is_positive));
#else
  const auto bits = is_positive & decltype(is_positive){1, 2, 4, 8};
  return (bits[0] | bits[1]) | (bits[2] | bits[3]);
#endif
}

/// One lane in all lanes.
template <int lane, class Number>
Simd<Number, 4> spread(Simd<Number, 4> a) {
  return {__builtin_shufflevector(a.value, a.value, lane, lane, lane, lane)};
}

/// Four groups are the columns of a matrix; they become its rows.
template <class Number>
void transpose(Simd<Number, 4>& a, Simd<Number, 4>& b, Simd<Number, 4>& c, Simd<Number, 4>& d) {
  const auto ab_low = __builtin_shufflevector(a.value, b.value, 0, 4, 1, 5);
  const auto ab_high = __builtin_shufflevector(a.value, b.value, 2, 6, 3, 7);
  const auto cd_low = __builtin_shufflevector(c.value, d.value, 0, 4, 1, 5);
  const auto cd_high = __builtin_shufflevector(c.value, d.value, 2, 6, 3, 7);
  a.value = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  b.value = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  c.value = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  d.value = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

/// Pairs are added first.
template <class Sum>
Sum sum_of_lanes(Float4 a) {
  return (Sum{a.value[0]} + Sum{a.value[1]}) + (Sum{a.value[2]} + Sum{a.value[3]});
}

/// Three components of vectors.
template <class Lanes>
struct Vec3Lanes {
  Lanes x, y, z;
};
template <class Lanes>
Vec3Lanes<Lanes> operator+(const Vec3Lanes<Lanes>& a, const Vec3Lanes<Lanes>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Lanes>
Vec3Lanes<Lanes> operator-(const Vec3Lanes<Lanes>& a, const Vec3Lanes<Lanes>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Lanes>
Vec3Lanes<Lanes> operator*(Lanes factor, const Vec3Lanes<Lanes>& a) {
  return {factor * a.x, factor * a.y, factor * a.z};
}
template <class Lanes>
Lanes dot(const Vec3Lanes<Lanes>& a, const Vec3Lanes<Lanes>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

}  // namespace pleat
