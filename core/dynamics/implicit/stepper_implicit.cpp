#include "core/dynamics/implicit/stepper_implicit.h"

#include "core/base/check.h"
#include "core/model/elasticity.h"

namespace pleat {

StepperImplicit::StepperImplicit(ClothModel& model, const MethodOptions& options)
    : Stepper(model, options, options.substeps, ContactMemory::last_substep),
      matrix_(model),
      solve_(model, make_solver(options, kMaxSolverIterations)),
      forces_(3, model.n_vertices()),
      positions_begin_(3, model.n_vertices()) {
  if (model_.contact) hold_.emplace(model_);
  solve_.analyze(matrix_);
  solve_.choose_pins(matrix_);
}

/// Fills the matrix with A = M + h C + h^2 K and `forces_`, which holds the external ones, with the
/// right-hand side h (f - h K v) = h f_elastic + h f_external - (A - M) v.
void StepperImplicit::assemble(const State& state, double h) {
  const StageScope scope(observer_, Stage::assembly);
  matrix_.set_zero();
  matrix_.add_masses(1);
  matrix_.add_elasticity(state.positions, h * h, h, ElementHessian::projected);
  add_elastic_forces(model_, state.positions, forces_);
  forces_ = h * forces_ + state.velocities * model_.masses.asDiagonal();
  flat(forces_).noalias() -=
      matrix_.lower().selfadjointView<Eigen::Lower>() * flat(state.velocities);
}

SolveReport StepperImplicit::substep(State& state, double time_end, double h) {
  positions_begin_ = state.positions;
  if (model_.bend_friction)
    model_.bend_friction->begin_substep(state, h, BendFriction::Knee::foreseen);
  set_external_forces(state, forces_);
  assemble(state, h);
  add_air_resistance(h, matrix_);
  matrix_.reduce_to_parents(flat(forces_));
  if (hold_) {
    const StageScope scope(observer_, Stage::contact);
    hold_->set_resistances(matrix_);
    hold_->choose(touches_, state, h);
    hold_->add(state.velocities, matrix_, forces_);
  }
  SolveReport report = solve_.advance(matrix_, forces_, state, time_end, h, observer_);
  if (report.ends_run()) return report;
  if (hold_) hold_->add_forces(state.velocities, h, contact_forces_);
  correct(positions_begin_, state, time_end, h, hold_ ? hold_->resistances() : model_.masses);
  return report;
}

}  // namespace pleat
