#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "core/base/vec.h"

namespace pleat {

/// Coordinates x y z x y z … as one column per vertex.
inline Positions columns(const Eigen::VectorXd& x) {
  return Eigen::Map<const Positions>(x.data(), 3, x.size() / 3);
}

/// Step of a central difference that balances truncation (step^2) against rounding (epsilon / step)
/// for a function whose variables and scale of change are both about `scale`: the relative error is
/// then near 1e-10.
inline double difference_step(double scale) {
  return std::cbrt(std::numeric_limits<double>::epsilon()) * scale;
}

/// Gradient of a scalar function at x by central differences.
///
/// energy  called as double(const Eigen::VectorXd&)
/// step    change of each variable, in the variable's unit, positive
template <class Energy>
Eigen::VectorXd difference_gradient(Energy&& energy, Eigen::VectorXd x, double step) {
  Eigen::VectorXd gradient(x.size());
  for (Eigen::Index variable = 0; variable < x.size(); ++variable) {
    const double kept = x[variable];
    const double ahead = kept + step;  // the steps actually taken, after rounding
    const double behind = kept - step;
    x[variable] = ahead;
    const double energy_ahead = energy(x);
    x[variable] = behind;
    const double energy_behind = energy(x);
    x[variable] = kept;
    gradient[variable] = (energy_ahead - energy_behind) / (ahead - behind);
  }
  return gradient;
}

/// Jacobian of a vector function at x by central differences; the Hessian when the function is a
/// gradient. Column c belongs to variable c.
///
/// function  called as Eigen::VectorXd(const Eigen::VectorXd&)
/// step      change of each variable, in the variable's unit, positive
template <class Function>
Eigen::MatrixXd difference_jacobian(Function&& function, Eigen::VectorXd x, double step) {
  Eigen::MatrixXd jacobian(function(x).size(), x.size());
  for (Eigen::Index variable = 0; variable < x.size(); ++variable) {
    const double kept = x[variable];
    const double ahead = kept + step;
    const double behind = kept - step;
    x[variable] = ahead;
    const Eigen::VectorXd value_ahead = function(x);
    x[variable] = behind;
    const Eigen::VectorXd value_behind = function(x);
    x[variable] = kept;
    jacobian.col(variable) = (value_ahead - value_behind) / (ahead - behind);
  }
  return jacobian;
}

/// |found - expected| / |expected|, in the Frobenius norm; the absolute difference where `expected`
/// is zero.
template <class Found, class Expected>
double relative_error(const Eigen::MatrixBase<Found>& found,
                      const Eigen::MatrixBase<Expected>& expected) {
  const double scale = expected.norm();
  return (found - expected).norm() / (scale > 0 ? scale : 1);
}

}  // namespace pleat
