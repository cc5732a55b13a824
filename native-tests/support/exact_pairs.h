#pragma once

#include <array>
#include <vector>

#include "core/base/vec.h"

namespace pleat {

/// A number that is never rounded: a sum of doubles that do not overlap, smallest first.
///
/// Exact while products and their tails neither overflow nor fall below 1e-300, and whatever the
/// compiler fuses. Source: Shewchuk, Adaptive precision floating-point arithmetic and fast robust
/// geometric predicates, Discrete & Computational Geometry 18, 1997 (grow-expansion and the theorem
/// that products summed so do not overlap).
class Exact {
 public:
  Exact(double number) : parts_(1, number) {}

  Exact operator+(const Exact& other) const;
  Exact operator-(const Exact& other) const;
  Exact operator*(const Exact& other) const;
  /// Compares with zero: -1, 0 or 1.
  int sign() const;

 private:
  void add(double number);

  std::vector<double> parts_;
};

/// Sign of n.(b - a), without rounding.
int exact_side(const Vec3& n, const Vec3& a, const Vec3& b);

/// Answer of a test that is exact but for where things only touch.
enum class Meeting {
  apart,
  touching,  ///< or in one plane, or without length or area
  crossing,  ///< the edge goes from one side to the other, through the inside
};

/// Edge against triangle, in places as they are stored, without rounding.
Meeting edge_and_triangle(const std::array<Vec3, 2>& edge, const std::array<Vec3, 3>& triangle);

/// Straight ways of a pair's vertices from time 0 to 1.
struct PairMotion {
  std::array<Vec3, 4> begin, end;  ///< places [m], the first side's before the second's
  int n_first = 1;                 ///< 1 of a vertex and a face, 2 of two edges
};

/// False where the sides surely stay apart from time 0 to 1. Times are halved until, in intervals
/// that hold all rounding, the sides are apart along an axis; what is not decided at a width of
/// 1e-12 counts as met.
bool may_meet(const PairMotion& motion);

}  // namespace pleat
