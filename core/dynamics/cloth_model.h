#pragma once

#include <optional>
#include <vector>

#include "core/base/motion.h"
#include "core/contact/contact_stage.h"
#include "core/dynamics/air_drag.h"
#include "core/fabric/spring_lattice.h"

namespace pleat {

/// A vertex whose place is prescribed: a constraint, not an infinite mass.
struct Pin {
  VertexId vertex;
  Vec3 place{0, 0, 0};  ///< at displacement zero [m]
  Motion motion;

  Vec3 position(double time) const { return place + motion.displacement(time); }
};

/// Which part of the relative velocity of a spring's ends its damper resists.
enum class DampingDirection {
  along_spring,  ///< does not brake rotation
  isotropic,     ///< every relative velocity
};

/// Everything that the equations of motion need; nothing that the scene did not ask for.
struct ClothModel {
  Eigen::VectorXd masses;  ///< lumped, one per vertex [kg], positive
  std::vector<Spring> springs;
  std::vector<BendElement> bends;
  DampingDirection damping_direction = DampingDirection::along_spring;
  Vec3 gravity{0, -9.81, 0};  ///< [m/s^2]
  std::vector<Pin> pins;      ///< at most one per vertex
  std::optional<AirDrag> air;
  std::optional<ContactStage> contact;
  RestCoordinates rest_coordinates;  ///< 2 x n [m], or empty: some steppers order their work by it

  int n_vertices() const { return static_cast<int>(masses.size()); }

  /// Throws ContractError when sizes, indices or signs break the promises above.
  void validate() const;
};

}  // namespace pleat
