#include "core/base/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/check.h"

namespace pleat {
namespace {

/// Error that a direction may have in its length or in a right angle; scene files carry 15 digits,
/// hand-written ones fewer.
constexpr double kUnitTolerance = 1e-9;

constexpr double kFlat = std::numeric_limits<double>::infinity();

bool is_positive(double size) { return size > 0 && std::isfinite(size); }
bool is_not_negative(double size) { return size >= 0 && std::isfinite(size); }

}  // namespace

void validate(const Plane& plane) {
  PLEAT_CHECK(plane.point.allFinite(), "a plane's point must be finite");
  PLEAT_CHECK(std::abs(plane.normal.norm() - 1) <= kUnitTolerance,
              "a plane's normal must be a unit vector");
}

void validate(const Sphere& sphere) {
  PLEAT_CHECK(sphere.centre.allFinite(), "a sphere's centre must be finite");
  PLEAT_CHECK(is_positive(sphere.radius), "a sphere's radius must be positive");
}

void validate(const RoundedCone& cone) {
  PLEAT_CHECK(cone.centre_a.allFinite() && cone.centre_b.allFinite(),
              "a rounded cone's centres must be finite");
  PLEAT_CHECK(is_positive(cone.radius_a) && is_positive(cone.radius_b),
              "a rounded cone's radii must be positive");
  PLEAT_CHECK(is_not_negative(cone.half_width_a) && is_not_negative(cone.half_width_b),
              "a rounded cone's half widths must not be negative");
  if (cone.half_width_a == 0 && cone.half_width_b == 0) return;
  const Vec3 axis = cone.centre_b - cone.centre_a;
  PLEAT_CHECK(std::abs(cone.across.norm() - 1) <= kUnitTolerance &&
                  std::abs(cone.across.dot(axis)) <= kUnitTolerance * axis.norm(),
              "a rounded cone's width must go along a unit vector perpendicular to its axis");
}

Plane placed(const Plane& plane, const Pose& pose) {
  return {pose * plane.point, pose.rotation * plane.normal};
}

Sphere placed(const Sphere& sphere, const Pose& pose) {
  return {pose * sphere.centre, sphere.radius};
}

RoundedCone placed(const RoundedCone& cone, const Pose& pose) {
  RoundedCone there = cone;
  there.centre_a = pose * cone.centre_a;
  there.centre_b = pose * cone.centre_b;
  there.across = pose.rotation * cone.across;
  return there;
}

std::array<double, 2> end_radii(const Plane& /*plane*/) { return {kFlat, kFlat}; }
std::array<double, 2> end_radii(const Sphere& sphere) { return {sphere.radius, sphere.radius}; }
std::array<double, 2> end_radii(const RoundedCone& cone) { return {cone.radius_a, cone.radius_b}; }

Sphere ball_around(const Plane& plane) { return {plane.point, kFlat}; }

Sphere ball_around(const Sphere& sphere) { return sphere; }

Sphere ball_around(const RoundedCone& cone) {
  const double half_length = (cone.centre_b - cone.centre_a).norm() / 2;
  const double half_width = std::max(cone.half_width_a, cone.half_width_b);
  return {(cone.centre_a + cone.centre_b) / 2,
          std::hypot(half_length, half_width) + std::max(cone.radius_a, cone.radius_b)};
}

}  // namespace pleat
