#include "core/body/body_motion.h"

#include <cmath>

#include "core/base/check.h"

namespace pleat {
namespace {

/// Coefficients c with (c_{k-1} + 4 c_k + c_{k+1}) / 6 = s_k, indices modulo n, for keys s. The
/// inverse of that filter has the poles p = sqrt(3) - 2 and 1/p, hence two recursions,
///
///     a_k = 6 s_k + p a_{k-1},     c_k = p (c_{k+1} - a_k);
///
/// what each starts from is its own sum over all earlier periods, a geometric series.
ChannelKeys spline_coefficients(const ChannelKeys& keys) {
  const double pole = std::sqrt(3.0) - 2;
  const Eigen::Index n = keys.cols();
  const double round = 1 - std::pow(pole, static_cast<double>(n));
  ChannelKeys c = 6 * keys;
  ChannelValues first = ChannelValues::Zero();
  double power = 1;
  for (Eigen::Index k = 0; k < n; ++k, power *= pole) first += power * c.col((n - k) % n);
  c.col(0) = first / round;
  for (Eigen::Index k = 1; k < n; ++k) c.col(k) += pole * c.col(k - 1);
  ChannelValues last = ChannelValues::Zero();
  power = pole;
  for (Eigen::Index k = 0; k < n; ++k, power *= pole) last -= power * c.col((n - 1 + k) % n);
  c.col(n - 1) = last / round;
  for (Eigen::Index k = n - 2; k >= 0; --k) c.col(k) = pole * (c.col(k + 1) - c.col(k));
  return c;
}

}  // namespace

void BodyMotion::validate() const {
  PLEAT_CHECK(keys.cols() >= kFewestKeys && keys.allFinite(), "at least four keys, all finite");
  PLEAT_CHECK(cycle_time > 0 && std::isfinite(cycle_time), "a cycle takes time");
  PLEAT_CHECK(std::isfinite(forward_speed) && std::isfinite(left_phase),
              "speed and phase are finite");
}

MotionCurves::MotionCurves(const ChannelKeys& keys) : coefficients_(spline_coefficients(keys)) {}

ChannelValues MotionCurves::at(double phase) const {
  const auto n = coefficients_.cols();
  const double place = (phase - std::floor(phase)) * static_cast<double>(n);
  const double s = place - std::floor(place);
  const auto key = static_cast<Eigen::Index>(place) % n;
  const double r = 1 - s;
  const auto around = [&](Eigen::Index offset) { return coefficients_.col((key + offset) % n); };
  return (r * r * r * around(n - 1) + (4 - 6 * s * s + 3 * s * s * s) * around(0) +
          (4 - 6 * r * r + 3 * r * r * r) * around(1) + s * s * s * around(2)) /
         6;
}

}  // namespace pleat
