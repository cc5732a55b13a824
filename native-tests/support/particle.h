#pragma once

#include "core/base/random.h"
#include "core/contact/contact_pass.h"

namespace pleat {

constexpr double kGravity = 9.81;  // [m/s^2]
inline const Vec3 kUp{0, 1, 0};

/// Bound of the distance that rounding leaves when coordinates are near 1 m [m].
constexpr double kRoundingDepth = 1e-14;

struct Particle {
  Vec3 position;  ///< [m]
  Vec3 velocity;  ///< [m/s]
};

/// The half space y < 0.
Collider floor_collider(double friction);
Collider ball_collider(const Vec3& centre, double radius, double friction);
Collider cone_collider(const RoundedCone& cone, double friction);

/// Motion at a constant velocity [m/s] from time 0 on, for 1000 s.
Motion steady_motion(const Vec3& velocity);

/// Turns about the origin by `spin` [rad/s] while that goes at `velocity` [m/s].
Motion turning_motion(const Vec3& spin, const Vec3& velocity);

Vec3 random_direction(Random& random);
/// A cone within a metre of the origin, of any kind: cones, capsules, with and without width, one
/// end inside of the other, hardly any length or none.
RoundedCone random_cone(Random& random);

/// How far a place [m] is above the surface of the solid at a time [s], without clearance [m].
double height(const Collider& collider, const Vec3& place, double time);

/// Contact for one vertex, as if it were alone in its cloth: `vertex` is 3 at most. True when a
/// solid touched it.
///
/// begin     where the substep begins [m]
/// position  where it ends [m], corrected;  velocity  [m/s], corrected
bool resolve(ContactPass& pass, VertexId vertex, const Vec3& begin, Vec3& position, Vec3& velocity);

/// One step of symplectic Euler under an acceleration [m/s^2], contact included. True when a
/// contact acted.
bool step(ContactPass& pass, const Vec3& acceleration, double time, double h, Particle& particle);

}  // namespace pleat
