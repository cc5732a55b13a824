#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#if defined(__wasm_simd128__)
#include <wasm_simd128.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace pleat {

/// One float under the interface of Float4, so that a kernel written once runs on a single lane.
struct Float1 {
  static constexpr int kLanes = 1;
  float value;

  static Float1 load(const float* from) { return {*from}; }
  static Float1 all(float number) { return {number}; }
  void store(float* to) const { *to = value; }
};
inline Float1 operator+(Float1 a, Float1 b) { return {a.value + b.value}; }
inline Float1 operator-(Float1 a, Float1 b) { return {a.value - b.value}; }
inline Float1 operator*(Float1 a, Float1 b) { return {a.value * b.value}; }
inline Float1 operator/(Float1 a, Float1 b) { return {a.value / b.value}; }
inline Float1 sqrt(Float1 a) { return {std::sqrt(a.value)}; }

/// The larger of a and b; a when it is not a number, so that an error is not hidden.
inline Float1 max(Float1 a, Float1 b) { return {a.value < b.value ? b.value : a.value}; }

/// The smaller of a and b; a when it is not a number.
inline Float1 min(Float1 a, Float1 b) { return {b.value < a.value ? b.value : a.value}; }

/// `a` where `condition` is positive, else zero.
inline Float1 where_positive(Float1 condition, Float1 a) {
  return {condition.value > 0 ? a.value : 0.0f};
}

/// Bit l is set where lane l is positive.
inline int positive_lanes(Float1 a) { return a.value > 0 ? 1 : 0; }

/// Four floats, computed with together. Loads and stores need no alignment.
///
/// Every operation rounds like its scalar form, so that both builds and Float1 agree to the bit.
struct Float4 {
  using Real = float;
  static constexpr int kLanes = 4;
#if defined(__wasm_simd128__)
  v128_t value;

  static Float4 load(const float* from) { return {wasm_v128_load(from)}; }
  static Float4 all(float number) { return {wasm_f32x4_splat(number)}; }
  static Float4 gather(const float* from, const std::array<int, 4>& at) {
    return {wasm_f32x4_make(from[at[0]], from[at[1]], from[at[2]], from[at[3]])};
  }
  void store(float* to) const { wasm_v128_store(to, value); }
#elif defined(__SSE2__)
  __m128 value;

  static Float4 load(const float* from) { return {_mm_loadu_ps(from)}; }
  static Float4 all(float number) { return {_mm_set1_ps(number)}; }
  static Float4 gather(const float* from, const std::array<int, 4>& at) {
    return {_mm_setr_ps(from[at[0]], from[at[1]], from[at[2]], from[at[3]])};
  }
  void store(float* to) const { _mm_storeu_ps(to, value); }
#else
  Float1 value[4];

  static Float4 load(const float* from) { return {{{from[0]}, {from[1]}, {from[2]}, {from[3]}}}; }
  static Float4 all(float number) { return {{{number}, {number}, {number}, {number}}}; }
  static Float4 gather(const float* from, const std::array<int, 4>& at) {
    return {{{from[at[0]]}, {from[at[1]]}, {from[at[2]]}, {from[at[3]]}}};
  }
  void store(float* to) const {
    for (int lane = 0; lane < 4; ++lane) value[lane].store(to + lane);
  }
#endif
  void scatter(float* to, const std::array<int, 4>& at) const {
    std::array<float, 4> numbers;
    store(numbers.data());
    for (std::size_t lane = 0; lane < 4; ++lane) to[at[lane]] = numbers[lane];
  }
};

#if defined(__wasm_simd128__)
inline Float4 operator+(Float4 a, Float4 b) { return {wasm_f32x4_add(a.value, b.value)}; }
inline Float4 operator-(Float4 a, Float4 b) { return {wasm_f32x4_sub(a.value, b.value)}; }
inline Float4 operator*(Float4 a, Float4 b) { return {wasm_f32x4_mul(a.value, b.value)}; }
inline Float4 operator/(Float4 a, Float4 b) { return {wasm_f32x4_div(a.value, b.value)}; }
inline Float4 sqrt(Float4 a) { return {wasm_f32x4_sqrt(a.value)}; }
inline Float4 max(Float4 a, Float4 b) { return {wasm_f32x4_pmax(a.value, b.value)}; }
inline Float4 min(Float4 a, Float4 b) { return {wasm_f32x4_pmin(a.value, b.value)}; }
inline Float4 where_positive(Float4 condition, Float4 a) {
  return {wasm_v128_and(wasm_f32x4_gt(condition.value, wasm_f32x4_splat(0)), a.value)};
}
inline int positive_lanes(Float4 a) {
  return static_cast<int>(wasm_i32x4_bitmask(wasm_f32x4_gt(a.value, wasm_f32x4_splat(0))));
}
#elif defined(__SSE2__)
inline Float4 operator+(Float4 a, Float4 b) { return {_mm_add_ps(a.value, b.value)}; }
inline Float4 operator-(Float4 a, Float4 b) { return {_mm_sub_ps(a.value, b.value)}; }
inline Float4 operator*(Float4 a, Float4 b) { return {_mm_mul_ps(a.value, b.value)}; }
inline Float4 operator/(Float4 a, Float4 b) { return {_mm_div_ps(a.value, b.value)}; }
inline Float4 sqrt(Float4 a) { return {_mm_sqrt_ps(a.value)}; }
// The instruction returns its second operand when either is not a number: hence the exchange.
inline Float4 max(Float4 a, Float4 b) { return {_mm_max_ps(b.value, a.value)}; }
inline Float4 min(Float4 a, Float4 b) { return {_mm_min_ps(b.value, a.value)}; }
inline Float4 where_positive(Float4 condition, Float4 a) {
  return {_mm_and_ps(_mm_cmpgt_ps(condition.value, _mm_setzero_ps()), a.value)};
}
inline int positive_lanes(Float4 a) {
  return _mm_movemask_ps(_mm_cmpgt_ps(a.value, _mm_setzero_ps()));
}
#else
template <class Operation>
Float4 lane_by_lane(Float4 a, Float4 b, Operation&& operation) {
  Float4 result;
  for (int lane = 0; lane < 4; ++lane) result.value[lane] = operation(a.value[lane], b.value[lane]);
  return result;
}
inline Float4 operator+(Float4 a, Float4 b) {
  return lane_by_lane(a, b, [](Float1 p, Float1 q) { return p + q; });
}
inline Float4 operator-(Float4 a, Float4 b) {
  return lane_by_lane(a, b, [](Float1 p, Float1 q) { return p - q; });
}
inline Float4 operator*(Float4 a, Float4 b) {
  return lane_by_lane(a, b, [](Float1 p, Float1 q) { return p * q; });
}
inline Float4 operator/(Float4 a, Float4 b) {
  return lane_by_lane(a, b, [](Float1 p, Float1 q) { return p / q; });
}
inline Float4 sqrt(Float4 a) {
  return lane_by_lane(a, a, [](Float1 p, Float1) { return sqrt(p); });
}
inline Float4 max(Float4 a, Float4 b) {
  return lane_by_lane(a, b, [](Float1 p, Float1 q) { return max(p, q); });
}
inline Float4 min(Float4 a, Float4 b) {
  return lane_by_lane(a, b, [](Float1 p, Float1 q) { return min(p, q); });
}
inline Float4 where_positive(Float4 condition, Float4 a) {
  return lane_by_lane(condition, a, [](Float1 p, Float1 q) { return where_positive(p, q); });
}
inline int positive_lanes(Float4 a) {
  int lanes = 0;
  for (int lane = 0; lane < 4; ++lane) lanes |= positive_lanes(a.value[lane]) << lane;
  return lanes;
}
#endif

/// Four groups are the columns of a matrix; they become its rows.
inline void transpose(Float4& a, Float4& b, Float4& c, Float4& d) {
#if defined(__wasm_simd128__)
  const v128_t ab_low = wasm_i32x4_shuffle(a.value, b.value, 0, 4, 1, 5);
  const v128_t ab_high = wasm_i32x4_shuffle(a.value, b.value, 2, 6, 3, 7);
  const v128_t cd_low = wasm_i32x4_shuffle(c.value, d.value, 0, 4, 1, 5);
  const v128_t cd_high = wasm_i32x4_shuffle(c.value, d.value, 2, 6, 3, 7);
  a.value = wasm_i64x2_shuffle(ab_low, cd_low, 0, 2);
  b.value = wasm_i64x2_shuffle(ab_low, cd_low, 1, 3);
  c.value = wasm_i64x2_shuffle(ab_high, cd_high, 0, 2);
  d.value = wasm_i64x2_shuffle(ab_high, cd_high, 1, 3);
#elif defined(__SSE2__)
  _MM_TRANSPOSE4_PS(a.value, b.value, c.value, d.value);
#else
  Float4* const rows[4] = {&a, &b, &c, &d};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j) std::swap(rows[i]->value[j], rows[j]->value[i]);
#endif
}

/// One lane in all lanes.
template <int lane>
Float4 spread(Float4 a) {
#if defined(__wasm_simd128__)
  return {wasm_i32x4_shuffle(a.value, a.value, lane, lane, lane, lane)};
#elif defined(__SSE2__)
  return {_mm_shuffle_ps(a.value, a.value, _MM_SHUFFLE(lane, lane, lane, lane))};
#else
  return {{a.value[lane], a.value[lane], a.value[lane], a.value[lane]}};
#endif
}

inline double sum_of_lanes(Float4 a) {
  float lanes[4];
  a.store(lanes);
  return (static_cast<double>(lanes[0]) + lanes[1]) + (static_cast<double>(lanes[2]) + lanes[3]);
}

/// Three components of four (or one) vectors.
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
