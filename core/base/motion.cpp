#include "core/base/motion.h"

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

}  // namespace

Vec3 Motion::displacement(double time) const {
  switch (kind) {
    case Kind::hold:
      return Vec3::Zero();
    case Kind::move:
      return progress(*this, time) * offset;
    case Kind::ease: {
      const double s = progress(*this, time);
      return s * s * (3 - 2 * s) * offset;
    }
    case Kind::oscillate:
      return std::sin(kTwoPi * frequency * std::max(0.0, time - time_begin)) * offset;
  }
  return Vec3::Zero();
}

Vec3 Motion::velocity(double time) const {
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
  }
  return Vec3::Zero();
}

}  // namespace pleat
