#include "core/base/motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace pleat {
namespace {

constexpr double kTwoPi = 6.283185307179586;

/// True while a motion between two times goes on; an empty interval is a jump.
bool is_under_way(const Motion& motion, double time) {
  return time >= motion.time_begin && time < motion.time_end;
}

/// Share of the interval that has passed, in [0, 1].
double progress(const Motion& motion, double time) {
  if (time >= motion.time_end) return 1;
  if (time <= motion.time_begin) return 0;
  return (time - motion.time_begin) / (motion.time_end - motion.time_begin);
}

/// Half the span of the central difference [s]: of a motion at 10 rad/s it errs by 2e-9 of the
/// speed, and rounding of metres by 1e-11 m/s.
constexpr double kDifference = 1e-5;

Vec3 displacement(const Motion& motion, double time) {
  switch (motion.kind) {
    case Motion::Kind::move:
      return progress(motion, time) * motion.offset;
    case Motion::Kind::ease: {
      const double s = progress(motion, time);
      return s * s * (3 - 2 * s) * motion.offset;
    }
    case Motion::Kind::oscillate:
      return std::sin(kTwoPi * motion.frequency * std::max(0.0, time - motion.time_begin)) *
             motion.offset;
    case Motion::Kind::hold:
    case Motion::Kind::turn:
    case Motion::Kind::follow:
      break;
  }
  return Vec3::Zero();
}

/// The line's points stay: R c + (c - R c) = c.
Pose turned(const Motion& motion, double time) {
  const double duration = std::clamp(time, motion.time_begin, motion.time_end) - motion.time_begin;
  const Mat3 rotation = Eigen::AngleAxisd(motion.rate * duration, motion.axis).toRotationMatrix();
  return {rotation, motion.centre - rotation * motion.centre};
}

}  // namespace

Pose Motion::pose(double time) const {
  if (kind == Kind::follow) return frame->pose(time);
  if (kind == Kind::turn) return turned(*this, time);
  return {Mat3::Identity(), displacement(*this, time)};
}

Vec3 Motion::velocity(const Vec3& place, double time) const {
  switch (kind) {
    case Kind::hold:
      return Vec3::Zero();
    case Kind::move:
      if (!is_under_way(*this, time)) return Vec3::Zero();
      return offset / (time_end - time_begin);
    case Kind::ease: {
      if (!is_under_way(*this, time)) return Vec3::Zero();
      const double s = progress(*this, time);
      return 6 * s * (1 - s) / (time_end - time_begin) * offset;
    }
    case Kind::oscillate: {
      if (time < time_begin) return Vec3::Zero();
      const double omega = kTwoPi * frequency;
      return omega * std::cos(omega * (time - time_begin)) * offset;
    }
    case Kind::turn:
      if (!is_under_way(*this, time)) return Vec3::Zero();
      return rate * axis.cross(turned(*this, time) * place - centre);
    case Kind::follow:
      return (frame->pose(time + kDifference) * place - frame->pose(time - kDifference) * place) /
             (2 * kDifference);
  }
  return Vec3::Zero();
}

}  // namespace pleat
