#pragma once

#include <array>
#include <variant>

#include "core/base/motion.h"
#include "core/base/shapes.h"
#include "core/contact/swept_cone.h"
#include "core/contact/swept_contact.h"

namespace pleat {

using SolidShape = std::variant<Plane, Sphere, RoundedCone>;
/// A solid over one substep, grown by its clearance.
using SweptSolid = std::variant<SweptPlane, SweptSphere, SweptCone>;

/// A solid that the cloth cannot enter.
struct Collider {
  SolidShape shape;  ///< its place at time 0
  Motion motion;
  double friction = 0.3;  ///< Coulomb coefficient against the cloth, not negative

  /// Throws ContractError for a radius that is not positive, directions that are not unit vectors,
  /// a cone's width that is not across its axis, negative friction, anything not finite.
  void validate() const;
};

SolidShape placed(const SolidShape& shape, const Pose& pose);

/// shape      where it is at the end of the substep
/// clearance  [m]
/// shift      how far it moves during the substep [m]
SweptSolid swept(const SolidShape& shape, const Clearance& clearance, const Vec3& shift);
Gap gap(const SweptSolid& solid, const Vec3& place);
/// Takes from the clearance.
void shrink(SweptSolid& solid, const Clearance& inset);

/// The radii of the balls that fill the shape [m]: at a rounded cone's ends, else twice the same;
/// infinite for a plane.
std::array<double, 2> end_radii(const SolidShape& shape);

}  // namespace pleat
