#pragma once

#include <array>

#include "core/base/pose.h"

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

/// Throws ContractError for a radius that is not positive, directions that are not unit vectors, a
/// cone's width that is not across its axis, anything not finite.
void validate(const Plane& plane);
void validate(const Sphere& sphere);
void validate(const RoundedCone& cone);

/// The shape that a rigid motion takes it to.
Plane placed(const Plane& plane, const Pose& pose);
Sphere placed(const Sphere& sphere, const Pose& pose);
RoundedCone placed(const RoundedCone& cone, const Pose& pose);

/// Radii of the balls that fill the shape [m]: at a rounded cone's ends, else twice the same;
/// infinite for a plane.
std::array<double, 2> end_radii(const Plane& plane);
std::array<double, 2> end_radii(const Sphere& sphere);
std::array<double, 2> end_radii(const RoundedCone& cone);

/// A ball about the middle of the shape that holds all of it; an infinite one of a plane.
Sphere ball_around(const Plane& plane);
Sphere ball_around(const Sphere& sphere);
Sphere ball_around(const RoundedCone& cone);

}  // namespace pleat
