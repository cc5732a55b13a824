#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pleat {

/// Four numbers of double precision under the interface of Float4, so that a program can be held
/// against itself without single precision's rounding.
struct Double4 {
  using Real = double;
  static constexpr int kLanes = 4;
  std::array<double, 4> value;

  static Double4 load(const double* from) { return {{from[0], from[1], from[2], from[3]}}; }
  static Double4 all(double number) { return {{number, number, number, number}}; }
  void store(double* to) const {
    for (std::size_t lane = 0; lane < 4; ++lane) to[lane] = value[lane];
  }
};

template <class Operation>
Double4 lane_by_lane(Double4 a, Double4 b, Operation&& operation) {
  Double4 result{};
  for (std::size_t lane = 0; lane < 4; ++lane)
    result.value[lane] = operation(a.value[lane], b.value[lane]);
  return result;
}
inline Double4 operator+(Double4 a, Double4 b) {
  return lane_by_lane(a, b, [](double p, double q) { return p + q; });
}
inline Double4 operator-(Double4 a, Double4 b) {
  return lane_by_lane(a, b, [](double p, double q) { return p - q; });
}
inline Double4 operator*(Double4 a, Double4 b) {
  return lane_by_lane(a, b, [](double p, double q) { return p * q; });
}
inline Double4 operator/(Double4 a, Double4 b) {
  return lane_by_lane(a, b, [](double p, double q) { return p / q; });
}
inline Double4 sqrt(Double4 a) {
  for (double& number : a.value) number = std::sqrt(number);
  return a;
}
/// As of Float4: a when it is not a number.
inline Double4 max(Double4 a, Double4 b) {
  return lane_by_lane(a, b, [](double p, double q) { return p < q ? q : p; });
}
inline Double4 min(Double4 a, Double4 b) {
  return lane_by_lane(a, b, [](double p, double q) { return q < p ? q : p; });
}
inline void transpose(Double4& a, Double4& b, Double4& c, Double4& d) {
  const std::array<Double4*, 4> rows = {&a, &b, &c, &d};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) std::swap(rows[i]->value[j], rows[j]->value[i]);
}
template <int lane>
Double4 spread(Double4 a) {
  return Double4::all(a.value[lane]);
}

}  // namespace pleat
