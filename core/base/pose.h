#pragma once

#include "core/base/vec.h"

namespace pleat {

/// A rigid motion: x is taken to rotation * x + translation.
struct Pose {
  Mat3 rotation = Mat3::Identity();  ///< proper orthonormal
  Vec3 translation{0, 0, 0};         ///< [m]

  Vec3 operator*(const Vec3& x) const { return rotation * x + translation; }
  Pose operator*(const Pose& first) const {
    return {rotation * first.rotation, *this * first.translation};
  }
  Pose inverse() const { return {rotation.transpose(), -(rotation.transpose() * translation)}; }
};

/// Something rigid that moves in a prescribed way, as a bone of a body does.
class MovingFrame {
 public:
  virtual ~MovingFrame() = default;
  /// Its displacement since time 0 [s]; the identity there.
  virtual Pose pose(double time) const = 0;
};

}  // namespace pleat
