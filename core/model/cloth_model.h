#pragma once

#include <optional>
#include <vector>

#include "core/base/motion.h"
#include "core/contact/contact_pass.h"
#include "core/contact/self_contact.h"
#include "core/fabric/chord_bending.h"
#include "core/fabric/hinge_bending.h"
#include "core/fabric/membrane.h"
#include "core/fabric/spring_lattice.h"
#include "core/linalg/sparse.h"
#include "core/mesh/triangle_mesh.h"
#include "core/model/air_drag.h"
#include "core/model/bend_friction.h"
#include "core/model/strain_limit.h"

namespace pleat {

/// A vertex whose place is prescribed: a constraint, not an infinite mass.
struct Pin {
  VertexId vertex;
  Vec3 place{0, 0, 0};  ///< place at time 0 of its motion [m]
  Motion motion;

  Vec3 position(double time) const { return motion.pose(time) * place; }
  Vec3 velocity(double time) const { return motion.velocity(place, time); }
};

/// Part of the relative velocity of a spring's ends that its damper resists.
enum class DampingDirection {
  along_spring,  ///< does not brake rotation
  isotropic,     ///< every relative velocity
};

/// Everything that the equations of motion need; nothing that the scene did not ask for.
struct ClothModel {
  Eigen::VectorXd masses;              ///< lumped, one per vertex [kg], positive; 0 where it hangs
  std::vector<HangingVertex> hanging;  ///< no unknowns; elements may join them like any others
  std::vector<Spring> springs;
  DampingDirection damping_direction = DampingDirection::along_spring;
  std::vector<Spring> taut_springs;  ///< pull beyond their rest length and never push; no damping
  std::vector<BendElement> bends;
  std::vector<ChordBend> chord_bends;
  std::optional<BendFriction> bend_friction;  ///< carries state; only for steppers that take it
  Membrane membrane;
  double membrane_relaxation = 0;  ///< tau of the membrane's Kelvin-Voigt damping [s]
  SparseMatrix fitted_bending;     ///< n x n, lower triangle [N/m]; 0 x 0 without it
  std::vector<Hinge> hinges;
  Vec3 gravity{0, -9.81, 0};  ///< [m/s^2]
  std::vector<Pin> pins;      ///< at most one per vertex, none where it hangs
  std::optional<AirDrag> air;
  std::optional<ContactPass> contact;
  std::optional<SelfContact> self_contact;
  std::optional<StrainLimit> strain_limit;
  TriangleMesh surface;  ///< base of coarser levels; empty unless the method asks for it
  RestCoordinates rest_coordinates;  ///< 2 x n [m], or empty: some steppers order their work by it

  int n_vertices() const { return static_cast<int>(masses.size()); }
  /// True where a vertex is in the middle of its parents, which have its mass.
  bool hangs(VertexId vertex) const { return masses[vertex] == 0; }
  /// Says for each vertex whether a pin holds it.
  std::vector<bool> pinned() const {
    std::vector<bool> is_pinned(static_cast<std::size_t>(n_vertices()), false);
    for (const Pin& pin : pins) is_pinned[pin.vertex] = true;
    return is_pinned;
  }
  /// True where bodies are in its way that are met by their surfaces.
  bool meets_bodies() const { return self_contact && !self_contact->bodies.empty(); }
  bool has_fitted_bending() const { return fitted_bending.rows() > 0; }
  /// True when springs and quadratic bending are all that holds it together: what position-based
  /// and projective steps are made for.
  bool is_plain_spring_lattice() const;

  /// Throws ContractError when sizes, indices or signs break the promises above.
  void validate() const;
};

}  // namespace pleat
