#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/dynamics/implicit/pair_hold.h"
#include "core/linalg/linear_solver.h"
#include "core/model/cloth_model.h"
#include "core/model/state.h"
#include "core/model/system_matrix.h"

namespace pleat {

/// The step whose moves an equilibrium is measured by [s]. In a shorter one stiff threads count by
/// more of their rounding, in a longer one soft bending by less.
constexpr double kEquilibriumStep = 1.0 / 60;

/// Says how far cloth at rest is from the equilibrium of its model, whatever stepper brought it
/// there: by the moves dx of one linear step of backward Euler from rest,
///
///     (M + h^2 K) dx = h^2 (f + contact),  share = sum m |dx| / (M g h^2),
///
/// f all forces of the model, K its stiffness. A share of 1 is cloth that nothing holds. Solids
/// push and rub within Coulomb's cone, cloth does so at cloth, pins hold. Neither state nor model
/// are changed.
///
/// Source: docs/methods/plausibility.md.
class EquilibriumCheck {
 public:
  /// model  outlives it and keeps its elements
  explicit EquilibriumCheck(const ClothModel& model);

  /// Share of the weight that is not balanced; nothing without weight, where strain limits hold the
  /// cloth, whose forces no one knows, and where the solver gives up.
  ///
  /// state  moves as one, more or less; what its velocities change is air and dampers
  /// time   [s]
  /// cloth_contact  what cloth that meets itself knows of its last substep; may be null
  std::optional<double> unbalanced_share(const State& state, double time,
                                         const ClothContact* cloth_contact = nullptr);

  /// Work so far for each vertex, in units of StepperType::substep_cost.
  double work() const { return work_; }

 private:
  /// A solid that may act on a vertex.
  struct Contact {
    enum class Hold {
      none,
      along_normal,  ///< it slips
      whole,         ///< it sticks
    };
    VertexId vertex;
    Vec3 normal;
    double friction;
    Vec3 target;                ///< move that the solid holds it to [m]
    Vec3 force = Vec3::Zero();  ///< contact force times h^2 [kg m]
    Hold hold = Hold::none;
    bool may_stick = false;
    double depth = 0;       ///< depth below where the solid holds it [m]
    double resistance = 0;  ///< [kg]
  };

  bool is_limited(const PositionsView& positions) const;
  void set_forces(const State& state, double time);
  void set_matrix(const State& state);
  void find_contacts(const State& state, double time);
  void press_from_both_sides();
  void choose_pairs(const State& state, double time, const ClothContact* cloth_contact);
  void choose_free();
  double share_of_moves() const;
  void take_solver(SolverKind kind);
  /// Finds the moves; false where the solver gives up.
  bool solve();
  /// A factor solves from now on.
  bool solve_by_factor();
  void take_force(Contact& contact) const;
  /// Takes the contact forces from the moves; true where a hold has changed.
  bool take_contact_forces();
  bool let_pairs_loose();

  const ClothModel& model_;
  SystemMatrix matrix_;
  SparseMatrix values_;  // values of the matrix without contacts
  SolverKind kind_ = SolverKind::cg;
  std::unique_ptr<LinearSolver> solver_;
  std::optional<AirDrag> air_;
  std::vector<Contact> contacts_;
  std::optional<PairHold> pairs_;  // null where cloth does not meet itself
  std::vector<char> is_free_;      // neither pinned nor hanging, for each vertex
  double weight_ = 0;              // M g h^2 of the free vertices [kg m]
  double least_residual_ = 0;      // least one that is worth solving for [kg m]
  Positions forces_;               // h^2 f [kg m]
  Positions rhs_;
  Positions moves_;       // dx [m]
  Positions correction_;  // [m]
  double work_;
};

}  // namespace pleat
