#include "core/dynamics/implicit/stepper_implicit.h"

#include <algorithm>
#include <utility>

#include "core/model/elasticity.h"

namespace pleat {
namespace {

/// Relative residual that is left at most while solids hold vertices. The right-hand side holds all
/// forces of threads: a thousandth of it may be much of a vertex's weight, by which solids hold and
/// let go.
constexpr double kHeldTolerance = 1e-5;

}  // namespace

StepperImplicit::StepperImplicit(ClothModel& model, const MethodOptions& options)
    : StepperImplicit(model, options, options.substeps) {
  take_implicitly(model);
}

StepperImplicit::StepperImplicit(ClothModel& model, const MethodOptions& options, int substeps)
    : Stepper(model, options, substeps, ContactForces::remembered),
      solve_(model, options.solver, make_solver(options, kMaxSolverIterations)),
      forces_(3, model.n_vertices()) {
  if (model_.contact) hold_.emplace(model_);
  if (cloth_contact_) pair_hold_.emplace(model_, *cloth_contact_);
}

void StepperImplicit::take_implicitly(const ClothModel& stiff) {
  stiff_ = &stiff;
  matrix_.emplace(stiff);
  solve_.analyze(*matrix_);
  solve_.choose_pins(*matrix_);
}

void StepperImplicit::choose_pairs(const State& state, double time_end, double h) {
  const PartScope scope(observer_, Part::cloth_contact);
  pair_hold_->choose(state, time_end, h);
  if (pair_hold_->fits(*matrix_)) return;
  matrix_->join(pair_hold_->joins());
  solve_.analyze(*matrix_);
  solve_.choose_pins(*matrix_);
}

/// Fills the matrix with A = M + h C + h^2 K and `forces_`, which holds the external ones, with the
/// right-hand side h (f - h K v) = h (f_elastic + f_explicit + f_external) - (A - M) v.
void StepperImplicit::assemble(const State& state, double h) {
  const PartScope scope(observer_, Part::assembly);
  matrix_->set_zero();
  matrix_->add_masses(1);
  matrix_->add_elasticity(state.positions, h * h, h, ElementHessian::projected);
  add_elastic_forces(*stiff_, state.positions, forces_);
  add_explicit_forces(state, forces_);
  forces_ = h * forces_ + state.velocities * model_.masses.asDiagonal();
  flat(forces_).noalias() -=
      matrix_->lower().selfadjointView<Eigen::Lower>() * flat(state.velocities);
}

/// Makes drag at the end of the substep part of its equations.
void StepperImplicit::add_air_resistance(double h) {
  if (!model_.air) return;
  for (int i = 0; i < model_.n_vertices(); ++i)
    matrix_->add_diagonal(VertexId(i), h * model_.air->resistance(VertexId(i)));
}

void StepperImplicit::hold(const State& state, double h) {
  const double asked = options().tolerance;
  bool any = false;
  if (pair_hold_) {
    const PartScope scope(observer_, Part::cloth_contact);
    pair_hold_->set_resistances(*matrix_);
    any = !pair_hold_->held().empty();
  }
  if (hold_) {
    const PartScope scope(observer_, Part::contact);
    hold_->set_resistances(*matrix_);
    hold_->choose(contact_memory_, state, h, &*matrix_);
    hold_->add(state.velocities, h, *matrix_, forces_);
    any = any || !hold_->held().empty();
  }
  if (pair_hold_) PairHold::add(pair_hold_->held(), state.velocities, h, {1, 1}, *matrix_, forces_);
  if (hold_ || pair_hold_) solve_.set_tolerance(any ? std::min(asked, kHeldTolerance) : asked);
}

/// Lets those go that a solid or cloth would pull or rub too much; false where there are none.
bool StepperImplicit::let_loose(const State& state, double h) {
  velocities_ = state.velocities + solve_.changes();
  bool any = false;
  if (hold_) {
    const auto freed = hold_->let_loose(contact_memory_, velocities_, h);
    hold_->take_out(freed, state.velocities, h, *matrix_, forces_);
    any = !freed.empty();
  }
  if (pair_hold_) {
    const auto lost = pair_hold_->let_loose(velocities_, h);
    PairHold::add(lost, state.velocities, h, {-1, -1}, *matrix_, forces_);
    any = any || !lost.empty();
  }
  return any;
}

SolveReport StepperImplicit::solve(const State& state, double time_end, double h) {
  SolveReport report = solve_.find_changes(*matrix_, forces_, state, time_end, h, observer_);
  if (!hold_ && !pair_hold_) return report;
  for (int n = 0; n < ContactHold::kMaxRepeats && !report.ends_run(); ++n) {
    if (!let_loose(state, h)) break;
    SolveReport again = solve_.find_changes_again(*matrix_, forces_, state, h, observer_);
    again.iterations += report.iterations;
    report = std::move(again);
  }
  return report;
}

SolveReport StepperImplicit::substep(State& state, double time_end, double h) {
  positions_begin_ = state.positions;
  if (model_.bend_friction)
    model_.bend_friction->begin_substep(state, h, BendFriction::Knee::foreseen);
  if (pair_hold_) choose_pairs(state, time_end, h);
  set_external_forces(state, forces_);
  assemble(state, h);
  add_air_resistance(h);
  matrix_->reduce_to_parents(flat(forces_));
  if (hold_ || pair_hold_) hold(state, h);
  SolveReport report = solve(state, time_end, h);
  if (report.ends_run()) return report;
  solve_.move(state, time_end, h);
  if (hold_) hold_->add_forces(state.velocities, h, contact_memory_.forces());
  if (pair_hold_) pair_hold_->remember(state.velocities, h, *cloth_contact_);
  correct(state, time_end, h, hold_ ? hold_->resistances() : model_.masses);
  return report;
}

}  // namespace pleat
