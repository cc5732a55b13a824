#include "core/contact/swept_contact.h"

#include <cmath>

namespace pleat {
namespace {

/// The direction in which a vertex in the very centre of a sphere is pushed.
const Vec3 kUp{0, 1, 0};

Vec3 outward(const Vec3& from_centre, double distance) {
  return distance > 0 ? Vec3(from_centre / distance) : kUp;
}

Impact on_sphere(const Vec3& centre, double radius, double fraction, const Vec3& from_centre) {
  const Vec3 normal = outward(from_centre, from_centre.norm());
  return {fraction, normal, centre + radius * normal};
}

}  // namespace

SweptPlane swept(const Plane& plane, const Clearance& clearance, const Vec3& shift) {
  return {plane.normal, plane.normal.dot(plane.point) + clearance.at_a, shift};
}

SweptSphere swept(const Sphere& sphere, const Clearance& clearance, const Vec3& shift) {
  return {sphere.centre, sphere.radius + clearance.at_a, shift};
}

std::optional<Impact> first_impact(const SweptPlane& plane, const Vec3& begin, const Vec3& end,
                                   double slack) {
  const double level = plane.level - slack;
  const double distance_end = plane.normal.dot(end) - level;
  if (!(distance_end < 0)) return std::nullopt;
  const Vec3 relative_begin = begin + plane.shift;
  const double distance_begin = plane.normal.dot(relative_begin) - level;
  if (!std::isfinite(distance_begin) || !end.allFinite()) return std::nullopt;
  const double fraction = distance_begin > 0 ? distance_begin / (distance_begin - distance_end) : 0;
  const Vec3 met = relative_begin + fraction * (end - relative_begin);
  return Impact{fraction, plane.normal, met - (plane.normal.dot(met) - plane.level) * plane.normal};
}

// Let a be from the centre to the start and d the path: |a + s d|^2 = r^2 has its smaller root at
// s = (a.a - r^2) / (-a.d + sqrt((a.d)^2 - d.d (a.a - r^2))), a form in which nothing cancels.
std::optional<Impact> first_impact(const SweptSphere& sphere, const Vec3& begin, const Vec3& end,
                                   double slack) {
  const double radius = sphere.radius - slack;
  const Vec3 from_centre = begin + sphere.shift - sphere.centre;
  const Vec3 path = end - begin - sphere.shift;
  const double excess = from_centre.squaredNorm() - radius * radius;
  const double approach = -from_centre.dot(path);
  if (!std::isfinite(excess) || !end.allFinite()) return std::nullopt;
  if (excess < 0) {
    const bool leaves = approach <= 0 && (from_centre + path).squaredNorm() >= radius * radius;
    if (leaves) return std::nullopt;
    return on_sphere(sphere.centre, sphere.radius, 0, from_centre);
  }
  if (!(approach > 0)) return std::nullopt;
  const double discriminant = approach * approach - path.squaredNorm() * excess;
  if (!(discriminant > 0)) return std::nullopt;
  const double fraction = excess / (approach + std::sqrt(discriminant));
  if (fraction > 1) return std::nullopt;
  return on_sphere(sphere.centre, sphere.radius, fraction, from_centre + fraction * path);
}

Gap gap(const SweptPlane& plane, const Vec3& place) {
  return {plane.normal.dot(place) - plane.level, plane.normal};
}

Gap gap(const SweptSphere& sphere, const Vec3& place) {
  const Vec3 from_centre = place - sphere.centre;
  const double distance = from_centre.norm();
  return {distance - sphere.radius, outward(from_centre, distance)};
}

void shrink(SweptPlane& plane, const Clearance& inset) { plane.level -= inset.at_a; }

void shrink(SweptSphere& sphere, const Clearance& inset) { sphere.radius -= inset.at_a; }

}  // namespace pleat
