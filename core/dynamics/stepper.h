#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/base/part_observer.h"
#include "core/dynamics/cloth_contact.h"
#include "core/dynamics/contact_memory.h"
#include "core/dynamics/first_contact.h"
#include "core/dynamics/method_options.h"
#include "core/dynamics/strain_limit_pass.h"
#include "core/model/cloth_model.h"
#include "core/model/state.h"

namespace pleat {

/// Further from the origin [m], or faster [m/s], than any cloth: a run that has come here has
/// diverged, though its numbers are finite still.
constexpr double kLargestCoordinate = 1e12;

/// Advances a state by one step. Every stepper works on the same model.
///
/// The model is shared and outlives the stepper. After its pins changed in number or vertex, call
/// `refresh`; after its rest lengths changed, `refresh_rest_lengths`; pins that only move need
/// neither.
class Stepper {
 public:
  virtual ~Stepper() = default;

  /// Steps from `time` to `time + step` [s], in equal substeps. Pinned vertices end exactly at
  /// their pins, hanging ones in the middle of their parents, where they are put first.
  /// After each substep the model's strain limit and contact correct the result. The report's
  /// residual is that of the last substep's own equations, its iterations the sum. A state that is
  /// not finite, or beyond kLargestCoordinate, ends the step: `state` then holds the last good one.
  /// Allocates nothing after the first call but messages.
  SolveReport advance(State& state, double time);

  virtual void refresh() = 0;
  /// Overridden by steppers that keep rest lengths in a layout of their own.
  virtual void refresh_rest_lengths() {}

  /// Forces by which solids held the vertices in the last substep [N]; no columns for steppers that
  /// do not remember them and for models without contact.
  const Positions& contact_forces() const { return contact_memory_.forces(); }
  /// Takes these for the forces of the substep before the first. Of no effect where none are
  /// remembered.
  void start_from_contact_forces(const PositionsView& forces);

  /// Says for each spring of the model whether it is taken implicitly; empty for steppers that
  /// treat all alike. Valid until the next call that changes the stepper.
  virtual std::span<const char> implicit_springs() const { return {}; }

  /// Names what the options ask for and this cloth has not, in a sentence's middle; empty for
  /// nothing.
  virtual std::string remark() const { return {}; }

  /// When a solid first touched the cloth since this was made, to the accuracy that
  /// MethodOptions::first_contact asks for [s]; nothing before, and where none is asked for.
  std::optional<double> first_contact() const { return first_contact_.time(); }

  /// Null where the model has none.
  const StrainLimitPass* strain_limit() const { return strain_limit_ ? &*strain_limit_ : nullptr; }

  /// Null where the model has none.
  const ClothContact* cloth_contact() const { return cloth_contact_ ? &*cloth_contact_ : nullptr; }

  void observe(PartObserver* observer) { observer_ = observer; }
  const MethodOptions& options() const { return options_; }
  int substeps() const { return substeps_; }

 protected:
  /// substeps  of a step
  Stepper(ClothModel& model, const MethodOptions& options, int substeps,
          ContactForces contact_forces = ContactForces::forgotten);

  /// Takes the state over at the start of a step and gives it back at its end; steppers with a
  /// layout of their own convert here. `store` may also complete the report: the residual is worth
  /// computing once per step only.
  virtual void load(const State& state);
  virtual void store(State& state, SolveReport& report);
  /// Advances by h [s] to time_end, corrections included; solids are placed, and the wind is that
  /// of the end. Hanging vertices follow by themselves.
  virtual SolveReport substep(State& state, double time_end, double h) = 0;

  /// Places of all vertices as they stand in a substep [m]; hanging ones need not be right. For
  /// steppers with a layout of their own.
  virtual void read_places(const State& state, PositionsRef places) const;
  /// Puts a vertex that does not hang at a place [m] and makes it that much faster [m/s].
  virtual void change(State& state, VertexId vertex, const Vec3& place, const Vec3& velocity);

  /// Ends a substep that started from positions_begin_: strain limit, contact on all vertices that
  /// neither hang nor are pinned, and pins, which win over both.
  ///
  /// resistances   how much each vertex resists a change of its velocity [kg]
  /// travel_share  how far a force f moves a vertex within the substep, in shares of h^2 f / its
  ///               resistance
  void correct(State& state, double time_end, double h, const Eigen::VectorXd& resistances,
               double travel_share = 1);

  /// Everything but elasticity, damping and remembered contact: weight, air [N]. Nothing where
  /// vertices hang.
  void set_external_forces(const State& state, PositionsRef forces);

  /// Bounds an iterative solver's way to the end of a substep; where it is reached, it has given
  /// up.
  static constexpr int kMaxSolverIterations = 2000;

  /// The solver that the options name; max_iterations is for cg and sor. Throws InputError when
  /// this build has none.
  static std::unique_ptr<LinearSolver> make_solver(const MethodOptions& options,
                                                   int max_iterations = 1);

  ClothModel& model_;
  PartObserver* observer_ = nullptr;
  ContactMemory contact_memory_;
  std::optional<ClothContact> cloth_contact_;  // models with self-contact only
  Positions positions_begin_;  // start of the substep, set by steppers that call correct

 private:
  SolveReport substep_in_world(State& state, double time_end, double h);
  void keep_cloth_apart(State& state, double time_end, double h);
  void resolve_contacts(State& state, double h, const Eigen::VectorXd& resistances,
                        double travel_share);
  void limit_among_contacts(State& state, double h, double travel_share);
  std::span<const ContactPass::Touch> touch_solids(State& state,
                                                   std::span<const ContactPass::Touch> settled);

  MethodOptions options_;
  int substeps_;
  std::optional<StrainLimitPass> strain_limit_;
  FirstContact first_contact_;
  State last_finite_;
  BendFriction::Kept last_friction_;  // state of friction inside the fabric, there
};

}  // namespace pleat
