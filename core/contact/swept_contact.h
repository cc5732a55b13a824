#pragma once

#include <optional>

#include "core/base/shapes.h"

namespace pleat {

/// Distance off a solid at which a vertex is held [m]: off a rounded cone at both of its ends, and
/// linearly between; off other shapes both are the same.
struct Clearance {
  double at_a = 0;
  double at_b = 0;
};

/// A plane over one substep, grown by its clearance: vertices keep n . x >= level at the end.
struct SweptPlane {
  Vec3 normal;       ///< unit, away from the solid
  double level = 0;  ///< [m], at the end of the substep
  Vec3 shift;        ///< how far the solid moves during the substep [m]
};

/// A sphere over one substep, grown by its clearance.
struct SweptSphere {
  Vec3 centre;        ///< its place at the end of the substep [m]
  double radius = 0;  ///< clearance included [m]
  Vec3 shift;         ///< how far the solid moves during the substep [m]
};

/// shape      where it is at the end of the substep
/// clearance  [m]
/// shift      how far it moves during the substep [m]
SweptPlane swept(const Plane& plane, const Clearance& clearance, const Vec3& shift);
SweptSphere swept(const Sphere& sphere, const Clearance& clearance, const Vec3& shift);

/// The first meeting of a vertex's straight path, seen from the moving solid, with the solid's
/// grown surface.
struct Impact {
  double fraction = 0;  ///< share of the substep, in [0, 1]; 0 for a vertex that begins inside
  Vec3 normal;          ///< unit, away from the solid
  Vec3 point;  ///< place on the surface where the solid is at the end of the substep [m]; for a
               ///< vertex that begins inside, the nearest one
};

/// begin, end  of the vertex's path [m]; a path that is not finite meets nothing
/// slack       a path that stays above this depth meets nothing [m]
std::optional<Impact> first_impact(const SweptPlane& plane, const Vec3& begin, const Vec3& end,
                                   double slack);
std::optional<Impact> first_impact(const SweptSphere& sphere, const Vec3& begin, const Vec3& end,
                                   double slack);

/// The grown surface's nearest point, seen from a place at the end of the substep.
struct Gap {
  double distance = 0;  ///< [m], negative inside
  Vec3 normal;          ///< unit, away from the solid
};
Gap gap(const SweptPlane& plane, const Vec3& place);
Gap gap(const SweptSphere& sphere, const Vec3& place);

/// Takes from the clearance.
void shrink(SweptPlane& plane, const Clearance& inset);
void shrink(SweptSphere& sphere, const Clearance& inset);

/// False when first_impact certainly finds nothing. Runs for every vertex, hence inline.
template <class Solid>
bool may_touch(const Solid& /*solid*/, const Vec3& /*begin*/, const Vec3& /*end*/) {
  return true;
}

inline bool may_touch(const SweptPlane& plane, const Vec3& /*begin*/, const Vec3& end) {
  return plane.normal.dot(end) < plane.level;
}

// Let a be from the centre to the start and d the path: |a + s d| is least at s = -a.d / d.d. Is
// it below r there, or at the end when the path stops before? (a.d)^2 > d.d (a.a - r^2) asks the
// first without a root.
inline bool may_touch(const SweptSphere& sphere, const Vec3& begin, const Vec3& end) {
  const Vec3 from_centre = begin + sphere.shift - sphere.centre;
  const Vec3 path = end - begin - sphere.shift;
  const double excess = from_centre.squaredNorm() - sphere.radius * sphere.radius;
  const double approach = -from_centre.dot(path);
  const double squared_path = path.squaredNorm();
  if (excess < 0) return true;
  if (!(approach > 0)) return false;
  if (approach >= squared_path) return excess + squared_path < 2 * approach;
  return approach * approach > squared_path * excess;
}

}  // namespace pleat
