#include "core/dynamics/stepper_imex.h"

#include "core/model/elasticity.h"

namespace pleat {

StepperImex::StepperImex(ClothModel& model, const MethodOptions& options)
    : Stepper(model, options, options.substeps, ContactMemory::none),
      solve_(model, make_solver(options, kMaxSolverIterations)),
      forces_(3, model.n_vertices()),
      positions_begin_(3, model.n_vertices()) {
  choose();
}

void StepperImex::choose() {
  parts_ = options().split == ImplicitSplit::structural
               ? split_structural(model_)
               : split_by_stability(model_, options().step / substeps());
  matrix_.emplace(parts_.stiff);
  solve_.analyze(*matrix_);
  solve_.choose_pins(*matrix_);
}

/// Fills the matrix with A = M + h C_I + h^2 K_I and `forces_`, which holds the external ones, with
/// the right-hand side h (f_E + f_I - h K_I v) = h (f - f_I's damping) - (A - M) v.
void StepperImex::assemble(const State& state, double h) {
  const StageScope scope(observer_, Stage::assembly);
  matrix_->set_zero();
  matrix_->add_masses(1);
  matrix_->add_elasticity(state.positions, h * h, h, ElementHessian::projected);
  add_elastic_forces(parts_.stiff, state.positions, forces_);
  add_internal_forces(parts_.soft, state.positions, state.velocities, forces_);
  forces_ = h * forces_ + state.velocities * model_.masses.asDiagonal();
  flat(forces_).noalias() -=
      matrix_->lower().selfadjointView<Eigen::Lower>() * flat(state.velocities);
}

SolveReport StepperImex::substep(State& state, double time_end, double h) {
  positions_begin_ = state.positions;
  set_external_forces(state, h, forces_);
  assemble(state, h);
  matrix_->reduce_to_parents(flat(forces_));
  SolveReport report = solve_.advance(*matrix_, forces_, state, time_end, h, observer_);
  if (report.ends_run()) return report;
  resolve_contacts(positions_begin_, state, time_end, h);
  return report;
}

}  // namespace pleat
