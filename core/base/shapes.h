#pragma once

#include "core/base/vec.h"

namespace pleat {

/// The half space below it is solid.
struct Plane {
  Vec3 point{0, 0, 0};   ///< any point of it [m]
  Vec3 normal{0, 1, 0};  ///< unit, away from the solid
};

struct Sphere {
  Vec3 centre{0, 0, 0};  ///< [m]
  double radius = 1;     ///< [m], positive
};

/// The hull of two balls, widened: balls fill it whose radius goes linearly from one end to the
/// other and whose centres fill the trapezoid that the half widths span across its axis. A cone or
/// a capsule has no width; without length it is a capsule across.
struct RoundedCone {
  Vec3 centre_a{0, 0, 0};   ///< [m]
  Vec3 centre_b{0, 1, 0};   ///< [m]
  double radius_a = 1;      ///< [m], positive
  double radius_b = 1;      ///< [m], positive
  Vec3 across{0, 0, 1};     ///< unit, perpendicular to the axis
  double half_width_a = 0;  ///< [m], not negative
  double half_width_b = 0;  ///< [m], not negative
};

}  // namespace pleat
