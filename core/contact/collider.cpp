#include "core/contact/collider.h"

#include <cmath>
#include <limits>

#include "core/base/check.h"

namespace pleat {
namespace {

/// How far a direction may be from unit length or from a right angle; scene files carry 15 digits,
/// hand-written ones fewer.
constexpr double kUnitTolerance = 1e-9;

bool is_positive(double size) { return size > 0 && std::isfinite(size); }
bool is_not_negative(double size) { return size >= 0 && std::isfinite(size); }

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

SweptPlane swept(const Plane& plane, const Clearance& clearance, const Vec3& shift) {
  return {plane.normal, plane.normal.dot(plane.point) + clearance.at_a, shift};
}

SweptSphere swept(const Sphere& sphere, const Clearance& clearance, const Vec3& shift) {
  return {sphere.centre, sphere.radius + clearance.at_a, shift};
}

}  // namespace

void Collider::validate() const {
  PLEAT_CHECK(is_not_negative(friction), "a collider's friction must not be negative");
  std::visit([](const auto& solid) { pleat::validate(solid); }, shape);
}

SolidShape placed(const SolidShape& shape, const Pose& pose) {
  return std::visit([&](const auto& solid) { return SolidShape(placed(solid, pose)); }, shape);
}

SweptSolid swept(const SolidShape& shape, const Clearance& clearance, const Vec3& shift) {
  return std::visit([&](const auto& solid) { return SweptSolid(swept(solid, clearance, shift)); },
                    shape);
}

Gap gap(const SweptSolid& solid, const Vec3& place) {
  return std::visit([&](const auto& shape) { return gap(shape, place); }, solid);
}

void shrink(SweptSolid& solid, const Clearance& inset) {
  std::visit([&](auto& shape) { shrink(shape, inset); }, solid);
}

std::array<double, 2> end_radii(const SolidShape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return {sphere->radius, sphere->radius};
  if (const auto* cone = std::get_if<RoundedCone>(&shape)) return {cone->radius_a, cone->radius_b};
  constexpr double kFlat = std::numeric_limits<double>::infinity();
  return {kFlat, kFlat};
}

}  // namespace pleat
