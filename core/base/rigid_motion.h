#pragma once

#include "core/base/vec.h"

namespace pleat {

/// A turn about one place, which goes to another.
struct RigidMotion {
  Mat3 rotation = Mat3::Identity();
  Vec3 centre = Vec3::Zero();        ///< [m]
  Vec3 moved_centre = Vec3::Zero();  ///< [m]

  double angle() const;  ///< [rad], 0 to pi
  Positions of(const Positions& places) const;
};

/// The rotation that done twice is this one, which turns by less than pi.
Mat3 half_turn(const Mat3& rotation);

/// The motion, without reflection, that takes places as near to others as squares tell. Where
/// several do alike, as for places on a line, about the one that turns least.
///
/// before, after  as many columns, at least one [m]
///
/// Source: Horn, Closed-form solution of absolute orientation using unit quaternions, J. Optical
/// Society of America A 4, 1987.
RigidMotion nearest_rigid_motion(const PositionsView& before, const PositionsView& after);

}  // namespace pleat
