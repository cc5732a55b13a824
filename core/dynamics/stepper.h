#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/stage_observer.h"
#include "core/dynamics/method_options.h"
#include "core/dynamics/strain_limit_stage.h"
#include "core/model/cloth_model.h"
#include "core/model/state.h"

namespace pleat {

class SystemMatrix;

/// Further from the origin [m], or faster [m/s], than any cloth: a run that has come here has
/// diverged, though its numbers are finite still.
constexpr double kLargestCoordinate = 1e12;

/// Advances a state by one step. Every stepper works on the same model, so that they can be
/// compared.
///
/// The model is shared and outlives the stepper. After its pins changed in number or vertex, call
/// `refresh`; after its rest lengths changed, `refresh_rest_lengths`; pins that only move need
/// neither.
class Stepper {
 public:
  virtual ~Stepper() = default;

  /// Steps from `time` to `time + step` [s], in equal substeps. Pinned vertices end exactly at
  /// their pins, hanging ones in the middle of their parents, where they are put to begin with.
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
  const Positions& contact_forces() const { return contact_forces_; }
  /// The same for the substep before the first. Of no effect where none are remembered.
  void start_from_contact_forces(const Eigen::Ref<const Positions>& forces);

  /// For each spring of the model, whether it is taken implicitly; empty for steppers that treat
  /// all alike. Valid until the next call that changes the stepper.
  virtual std::span<const char> implicit_springs() const { return {}; }

  /// What the options ask for and this cloth has not, in a sentence's middle; empty for nothing.
  virtual std::string remark() const { return {}; }

  /// When a solid first touched the cloth since this was made, to the accuracy that
  /// MethodOptions::first_contact asks for [s]; nothing before, and where none is asked for.
  std::optional<double> first_contact() const { return first_contact_; }

  /// Null where the model has none.
  const StrainLimitStage* strain_limit() const { return strain_limit_ ? &*strain_limit_ : nullptr; }

  void observe(StageObserver* observer) { observer_ = observer; }
  const MethodOptions& options() const { return options_; }
  int substeps() const { return substeps_; }

 protected:
  /// Whether the force with which a solid held a vertex in one substep is among the forces of the
  /// next. The equations of a stepper that solves for the end of a substep then contain the
  /// support: cloth comes to rest in equilibrium instead of falling into the solid and being put
  /// back in every substep.
  enum class ContactMemory { none, last_substep };

  Stepper(ClothModel& model, const MethodOptions& options, int substeps, ContactMemory memory);

  /// Takes the state over at the begin of a step and gives it back at its end; steppers with a
  /// layout of their own convert here. `store` may also complete the report: the residual is worth
  /// computing once per step only.
  virtual void load(const State& state);
  virtual void store(State& state, SolveReport& report);
  /// One substep of h [s] ending at time_end, corrections included; solids are placed, and the wind
  /// is that of its end. Hanging vertices follow by themselves.
  virtual SolveReport substep(State& state, double time_end, double h) = 0;

  /// True when what a stepper proposes for the end of a substep may need to be corrected.
  bool has_corrections() const { return model_.contact || strain_limit_; }
  /// The shared way a substep ends: strain limit, contact on all vertices that neither hang nor are
  /// pinned, and pins, which win over both.
  ///
  /// resistances   how much each vertex resists a change of its velocity [kg]
  /// travel_share  how far a force f moves a vertex within the substep, in shares of h^2 f / its
  ///               resistance
  void correct(const Positions& positions_begin, State& state, double time_end, double h,
               const Eigen::VectorXd& resistances, double travel_share = 1);
  /// The same with the masses alone.
  void correct(const Positions& positions_begin, State& state, double time_end, double h) {
    correct(positions_begin, state, time_end, h, model_.masses);
  }
  /// Everything but elasticity and damping: weight, air, remembered contact [N]. Nothing where
  /// vertices hang.
  void set_external_forces(const State& state, Eigen::Ref<Positions> forces);
  /// The same for steppers whose substep of h [s] does not solve for drag.
  void set_damped_external_forces(const State& state, double h, Eigen::Ref<Positions> forces);
  void add_damped_air(const State& state, double h, Eigen::Ref<Positions> forces);
  /// Adds what makes drag at the end of a substep of h [s] part of its equations, to the matrix
  /// that multiplies the change of velocity.
  void add_air_resistance(double h, SystemMatrix& matrix) const;
  /// The same without air.
  void set_steady_forces(Eigen::Ref<Positions> forces);

  /// Of an iterative solver's way to the end of a substep; reaching it is reported as not
  /// converged.
  static constexpr int kMaxSolverIterations = 2000;

  /// The solver that the options name; max_iterations is for cg and sor. Throws InputError when
  /// this build has none.
  static std::unique_ptr<LinearSolver> make_solver(const MethodOptions& options,
                                                   int max_iterations = 1);

  ClothModel& model_;
  StageObserver* observer_ = nullptr;
  /// Kept from the last substep: the force [N] with which solids held each vertex, and how the last
  /// of them touched it.
  Positions contact_forces_;
  std::vector<ContactStage::Touch> touches_;

 private:
  SolveReport substep_in_world(State& state, double time_end, double h);
  SolveReport substep_to_contact(State& state, double time_end, double h);
  bool awaits_contact() const;
  void begin_again(State& state);
  void place_solids(double time_begin, double time_end);
  void resolve_contacts(const Positions& positions_begin, State& state, double h,
                        const Eigen::VectorXd& resistances, double travel_share);
  void limit_among_contacts(const Positions& positions_begin, State& state, double h,
                            double travel_share);
  std::span<const ContactStage::Touch> correct_for_contact(const Positions& positions_begin,
                                                           State& state);
  void let_go(State& state, double h, const Eigen::VectorXd& resistances, double travel_share);
  void forget_untouched(std::span<const ContactStage::Touch> touches);
  void remember_friction(const Positions& positions_begin, const State& state, double h,
                         const Eigen::VectorXd& resistances);
  void remember(std::span<const ContactStage::Touch> touches, const Positions& velocities,
                double h);

  MethodOptions options_;
  int substeps_;
  ContactMemory memory_;
  std::optional<StrainLimitStage> strain_limit_;
  std::vector<char> is_exempt_;  // of contact, for each vertex
  bool is_touched_ = false;      // in the last substep
  std::optional<double> first_contact_;
  Positions air_forces_;  // of the last substep, where steppers need it [N]
  State before_contact_;  // where first contact is looked for
  Positions forces_before_contact_;
  Positions solved_velocities_;  // before contact [m/s]; of steppers that remember
  State last_finite_;
  BendFriction::Kept last_friction_;  // of that state, with friction inside the fabric
  BendFriction::Kept friction_before_contact_;
};

}  // namespace pleat
