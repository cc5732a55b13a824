#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pleat {

struct CurvePoint {
  double x = 0;
  double y = 0;
};

enum class CurveShape : std::uint8_t {
  level,     ///< the mean of y, whatever x
  straight,  ///< the line of least squares
  curved,
};

/// A natural cubic spline: through its knots, twice continuously differentiable, without curvature
/// at both ends.
struct SmoothingSpline {
  struct Knot {
    double x = 0;
    double value = 0;
    double second_derivative = 0;
  };
  std::vector<Knot> knots;  ///< knots at every x that a point has, ascending
  CurveShape shape = CurveShape::curved;
  double smoothing = 0;  ///< lambda, from 0 to infinity
  /// Root of the mean over all points of (y_i - f_i(x_i))^2, f_i fitted to the others with the same
  /// lambda. Beyond the others' x, f_i goes on along a line.
  double leave_one_out_error = 0;

  double low() const { return knots.front().x; }
  double high() const { return knots.back().x; }
  /// Taken at the place from low() to high() nearest to x. Throws ContractError for NaN.
  double value(double x) const;
};

/// The function of least sum_i (y_i - f(x_i))^2 + lambda * integral of f''(u)^2 du, with u = x
/// scaled to [0, 1]. Points may share an x.
///
/// lambda  0: through the mean of the points at each x; infinity: the line of least squares
///
/// Throws ContractError for a negative or NaN lambda, for points that are not finite and for fewer
/// than three different x.
/// Source: Reinsch, Smoothing by spline functions, Numerische Mathematik 10, 1967; Green &
/// Silverman, Nonparametric Regression and Generalized Linear Models, Chapman & Hall 1994, chapters
/// 2 and 3.
SmoothingSpline smoothing_spline(std::span<const CurvePoint> points, double smoothing);

/// The curve of least leave-one-out error among the mean of y and the splines of all lambda
/// (between the limits of lambda the lowest on a grid, refined). Throws ContractError as
/// smoothing_spline does.
SmoothingSpline best_smoothing_spline(std::span<const CurvePoint> points);

}  // namespace pleat
