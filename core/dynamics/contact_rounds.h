#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/contact/contact_stage.h"
#include "core/linalg/linear_solver.h"
#include "core/model/cloth_model.h"

namespace pleat {

/// Dry frictional contact among the rounds of a solve whose matrix A [N/m] stays as it is, the same
/// for x, y and z.
///
/// The forces of solids are on the right-hand side. After a round they change by what they lack to
/// Signorini's and Coulomb's law where it has put the vertices: a vertex is let go by its force,
/// the contact stage says where a solid holds it then, and the force pulls it there, by a stiffness
/// of its own. With m the masses of held vertices, 0 elsewhere, and A s = m/h^2, that is m/(h^2 s):
/// its mass where all of a sheet is held, and what one vertex alone resists with where nothing else
/// is. As no entry of A^-1 is negative where springs join the vertices, the change moves no shape
/// of the held ones by more than it lacks.
///
/// Of a vertex between several solids, the one that acted last presses. Allocates nothing after the
/// first call. Source: Ly, Jouve, Boissieux & Bertails-Descoubes, Projective dynamics with dry
/// frictional contact, ACM Transactions on Graphics 39(4), 2020, where the stiffness is m/h^2;
/// docs/methods/projective.md.
class ContactRounds {
 public:
  /// Of a model with contact, which outlives this.
  explicit ContactRounds(ClothModel& model);

  /// For substeps of h [s] with another matrix, of which this is the diagonal [N/m]. Contact leaves
  /// vertices alone that are not free.
  void refresh(const Eigen::VectorXd& diagonal, double h, std::span<const char> is_free);

  struct Change {
    VertexId vertex;
    Vec3 force;  ///< to be added [N]
  };

  /// How the forces of solids change after a round; valid until the next call.
  ///
  /// begin   places at the begin of the substep that the contact stage is at [m]
  /// end     where the round has put the vertices [m]
  /// forces  by which solids held them in it [N]
  /// solver  with the factor of the matrix
  std::span<const Change> after_round(const Positions& begin, const Positions& end,
                                      const Positions& forces, LinearSolver& solver);

  /// How much each vertex alone resists a change of its velocity [kg].
  const Eigen::VectorXd& resistances() const { return resistances_; }

 private:
  /// What a solid does to a vertex that its force lets go.
  struct Hold {
    VertexId vertex;
    Vec3 normal;      // unit, away from the solid
    double friction;  // Coulomb coefficient
    bool sticks;
    Vec3 lack;  // from the round's place to where the solid holds it [m]
    Vec3 pull;  // from where it would be, were it let go [m]
  };

  std::optional<Hold> hold(VertexId vertex, const Vec3& begin, const Vec3& end, const Vec3& force);
  void find_held(const Positions& begin, const Positions& end, const Positions& forces);
  void set_stiffnesses(LinearSolver& solver);

  ClothModel& model_;
  double h_ = 0;
  std::vector<char> is_free_;
  Eigen::VectorXd resistances_;
  Eigen::VectorXd diagonal_;
  Eigen::VectorXd held_masses_;  // over h^2, 0 where nothing is held [N/m]
  Eigen::VectorXd held_masses_before_;
  Eigen::VectorXd shares_;       // s
  Eigen::VectorXd stiffnesses_;  // of vertices that are not held, the diagonal's [N/m]
  std::vector<Hold> holds_;
  std::vector<Change> changes_;
};

}  // namespace pleat
