#pragma once

#include <array>
#include <variant>

#include "core/base/motion.h"
#include "core/contact/solid_shape.h"

namespace pleat {

/// A solid that the cloth cannot enter.
struct Collider {
  SolidShape shape;  ///< its place at time 0
  Motion motion;
  double friction = 0.3;  ///< Coulomb coefficient against the cloth, not negative

  /// Throws ContractError for a shape that is not valid and for negative friction.
  void validate() const;
};

// Templates, as a solid that lacks one of these would otherwise become a variant and call itself.

template <class... Shapes>
std::variant<Shapes...> placed(const std::variant<Shapes...>& shape, const Pose& pose) {
  return std::visit(
      [&](const auto& solid) -> std::variant<Shapes...> { return placed(solid, pose); }, shape);
}

template <class... Shapes>
std::array<double, 2> end_radii(const std::variant<Shapes...>& shape) {
  return std::visit([](const auto& solid) { return end_radii(solid); }, shape);
}

template <class... Shapes>
Sphere ball_around(const std::variant<Shapes...>& shape) {
  return std::visit([](const auto& solid) { return ball_around(solid); }, shape);
}

/// shape      where it is at the end of the substep
/// clearance  [m]
/// shift      how far it moves during the substep [m]
template <class... Shapes>
auto swept(const std::variant<Shapes...>& shape, const Clearance& clearance, const Vec3& shift) {
  using Solid = std::variant<decltype(swept(Shapes{}, clearance, shift))...>;
  return std::visit([&](const auto& solid) -> Solid { return swept(solid, clearance, shift); },
                    shape);
}

/// A solid over one substep, grown by its clearance.
using SweptSolid = decltype(swept(SolidShape{}, Clearance{}, Vec3{}));

template <class... Shapes>
Gap gap(const std::variant<Shapes...>& solid, const Vec3& place) {
  return std::visit([&](const auto& shape) { return gap(shape, place); }, solid);
}

/// Takes from the clearance.
template <class... Shapes>
void shrink(std::variant<Shapes...>& solid, const Clearance& inset) {
  std::visit([&](auto& shape) { shrink(shape, inset); }, solid);
}

}  // namespace pleat
