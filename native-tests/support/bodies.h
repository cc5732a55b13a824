#pragma once

#include "core/contact/body_surface.h"

namespace pleat {

/// A regular octahedron's faces split into 4^levels and put on a sphere about the origin.
BodySurface ball_body(double radius, int levels);

/// Height above a box about the origin, along the axes, negative inside.
double height_above_box(const Vec3& size, const Vec3& place);

/// Turns about an axis through the origin at a steady rate.
class Spin final : public MovingFrame {
 public:
  /// rate  [rad/s]
  Spin(const Vec3& axis, double rate) : axis_(axis), rate_(rate) {}
  Pose pose(double time) const override {
    return {Eigen::AngleAxisd(rate_ * time, axis_).toRotationMatrix(), Vec3(0, 0, 0)};
  }

 private:
  Vec3 axis_;
  double rate_;
};

}  // namespace pleat
