#include "native-tests/support/exact_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pleat {
namespace {

using ExactVec = std::array<Exact, 3>;

ExactVec difference(const Vec3& b, const Vec3& a) {
  return {Exact(b[0]) - a[0], Exact(b[1]) - a[1], Exact(b[2]) - a[2]};
}

Exact dot(const ExactVec& a, const ExactVec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

ExactVec cross(const ExactVec& a, const ExactVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Side of the plane through a, b and c on which d is.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return dot(cross(difference(b, a), difference(c, a)), difference(d, a)).sign();
}

/// Bounds of a number, wider than its rounding.
struct Interval {
  double low = 0;
  double high = 0;
};

/// An operation rounds by half an ulp, and an ulp is at most 2^-52 of the number.
Interval widened(double low, double high) {
  const double least = std::numeric_limits<double>::min();
  return {low - 0x1p-52 * std::abs(low) - least, high + 0x1p-52 * std::abs(high) + least};
}
Interval operator+(const Interval& a, const Interval& b) {
  return widened(a.low + b.low, a.high + b.high);
}
Interval operator-(const Interval& a, const Interval& b) {
  return widened(a.low - b.high, a.high - b.low);
}
Interval operator*(const Interval& a, const Interval& b) {
  const auto [low, high] =
      std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return widened(low, high);
}
Interval exactly(double number) { return {number, number}; }

struct MovingDifference {
  Vec3 begin, end;                             ///< rounded, for axes alone [m]
  std::array<Interval, 3> bounds_0, bounds_1;  ///< true ones at time 0 and 1 [m]
};

std::vector<MovingDifference> moving_differences(const PairMotion& motion) {
  std::vector<MovingDifference> all;
  const auto n_first = static_cast<std::size_t>(motion.n_first);
  for (std::size_t a = 0; a < n_first; ++a)
    for (std::size_t b = n_first; b < 4; ++b) {
      MovingDifference d;
      d.begin = motion.begin[b] - motion.begin[a];
      d.end = motion.end[b] - motion.end[a];
      for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        d.bounds_0[k] = exactly(motion.begin[b][i]) - exactly(motion.begin[a][i]);
        d.bounds_1[k] = exactly(motion.end[b][i]) - exactly(motion.end[a][i]);
      }
      all.push_back(d);
    }
  return all;
}

Interval along(const Vec3& axis, const std::array<Interval, 3>& d) {
  return exactly(axis[0]) * d[0] + exactly(axis[1]) * d[1] + exactly(axis[2]) * d[2];
}

/// True where every difference has a positive part along the axis at all times between two.
bool stays_ahead(const std::vector<MovingDifference>& differences, const Vec3& axis, double from,
                 double to) {
  return std::all_of(differences.begin(), differences.end(), [&](const MovingDifference& d) {
    const Interval at_0 = along(axis, d.bounds_0);
    const Interval at_1 = along(axis, d.bounds_1);
    return (at_0 + Interval{from, to} * (at_1 - at_0)).low > 0;
  });
}

/// The axis, of all that single differences, two and three of them give, along which the least
/// difference at a time is longest. Zero where none is positive.
Vec3 best_axis(const std::vector<MovingDifference>& differences, double time) {
  std::vector<Vec3> places;
  places.reserve(differences.size());
  for (const MovingDifference& d : differences)
    places.emplace_back((1 - time) * d.begin + time * d.end);
  Vec3 best = Vec3::Zero();
  double most = 0;
  const auto try_axis = [&](const Vec3& axis) {
    const double length = axis.norm();
    if (!(length > 0)) return;
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& place : places) least = std::min(least, axis.dot(place) / length);
    if (least > most) {
      most = least;
      best = axis / length;
    }
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    try_axis(places[i]);
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 side = places[j] - places[i];
      try_axis(side.cross(places[i].cross(side)));
      for (std::size_t k = 0; k < j; ++k) {
        const Vec3 normal = side.cross(places[k] - places[i]);
        try_axis(normal);
        try_axis(-normal);
      }
    }
  }
  return best;
}

bool may_meet_between(const std::vector<MovingDifference>& differences, double from, double to) {
  constexpr double kLeastWidth = 1e-12;
  const double middle = from + (to - from) / 2;
  if (stays_ahead(differences, best_axis(differences, middle), from, to)) return false;
  if (to - from < kLeastWidth) return true;
  return may_meet_between(differences, from, middle) || may_meet_between(differences, middle, to);
}

}  // namespace

// Knuth's sum of two doubles and its error, without a condition on their sizes.
void Exact::add(double number) {
  std::vector<double> parts;
  for (const double part : parts_) {
    const double sum = number + part;
    const double of_part = sum - number;
    const double error = (number - (sum - of_part)) + (part - of_part);
    if (error != 0) parts.push_back(error);
    number = sum;
  }
  if (number != 0 || parts.empty()) parts.push_back(number);
  parts_ = std::move(parts);
}

Exact Exact::operator+(const Exact& other) const {
  Exact sum = *this;
  for (const double part : other.parts_) sum.add(part);
  return sum;
}

Exact Exact::operator-(const Exact& other) const {
  Exact result = *this;
  for (const double part : other.parts_) result.add(-part);
  return result;
}

Exact Exact::operator*(const Exact& other) const {
  Exact product(0);
  for (const double a : parts_)
    for (const double b : other.parts_) {
      const double rounded = a * b;
      product.add(std::fma(a, b, -rounded));
      product.add(rounded);
    }
  return product;
}

int Exact::sign() const { return parts_.back() > 0 ? 1 : parts_.back() < 0 ? -1 : 0; }

int exact_side(const Vec3& n, const Vec3& a, const Vec3& b) {
  return dot({n[0], n[1], n[2]}, difference(b, a)).sign();
}

Meeting edge_and_triangle(const std::array<Vec3, 2>& edge, const std::array<Vec3, 3>& triangle) {
  const int end_0 = orientation(triangle[0], triangle[1], triangle[2], edge[0]);
  const int end_1 = orientation(triangle[0], triangle[1], triangle[2], edge[1]);
  if (end_0 * end_1 > 0) return Meeting::apart;
  if (end_0 == 0 && end_1 == 0) return Meeting::touching;
  std::array<int, 3> turns;
  for (std::size_t k = 0; k < 3; ++k)
    turns[k] = orientation(edge[0], edge[1], triangle[k], triangle[(k + 1) % 3]);
  const auto [least, most] = std::minmax({turns[0], turns[1], turns[2]});
  if (least < 0 && most > 0) return Meeting::apart;
  return end_0 * end_1 < 0 && least * most > 0 ? Meeting::crossing : Meeting::touching;
}

bool may_meet(const PairMotion& motion) {
  return may_meet_between(moving_differences(motion), 0, 1);
}

}  // namespace pleat
