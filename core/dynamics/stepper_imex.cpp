#include "core/dynamics/stepper_imex.h"

#include "core/model/elasticity.h"

namespace pleat {
StepperImex::StepperImex(ClothModel& model, const MethodOptions& options)
    : Stepper(model, options, options.substeps, ContactMemory::none),
      solver_(make_solver(options, kMaxSolverIterations)),
      forces_(3, model.n_vertices()),
      velocity_changes_(Positions::Zero(3, model.n_vertices())),
      positions_begin_(3, model.n_vertices()) {
  choose();
}

void StepperImex::choose() {
  parts_ = options().split == ImplicitSplit::structural
               ? split_structural(model_)
               : split_by_stability(model_, options().step / substeps());
  matrix_.emplace(parts_.stiff);
  solver_->analyze(matrix_->lower());
  std::vector<VertexId> vertices;
  for (const Pin& pin : model_.pins) vertices.push_back(pin.vertex);
  matrix_->choose_prescribed(vertices);
  pin_changes_.resize(3, static_cast<Eigen::Index>(vertices.size()));
}

/// Fills the matrix with A = M + h C_I + h^2 K_I and `forces_`, which holds the external ones, with
/// the right-hand side h (f_E + f_I - h K_I v) = h (f - f_I's damping) - (A - M) v.
void StepperImex::assemble(const State& state, double h) {
  const StageScope scope(observer_, Stage::assembly);
  matrix_->set_zero();
  matrix_->add_masses(1);
  matrix_->add_elasticity(state.positions, h * h, h, ElementHessian::projected);
  add_elastic_forces(parts_.stiff, state.positions, forces_);
  add_elastic_forces(parts_.soft, state.positions, forces_);
  add_damping_forces(parts_.soft, state.positions, state.velocities, forces_);
  forces_ = h * forces_ + state.velocities * model_.masses.asDiagonal();
  flat(forces_).noalias() -=
      matrix_->lower().selfadjointView<Eigen::Lower>() * flat(state.velocities);
}

SolveReport StepperImex::substep(State& state, double time_end, double h) {
  positions_begin_ = state.positions;
  set_external_forces(state, h, forces_);
  assemble(state, h);
  for (std::size_t p = 0; p < model_.pins.size(); ++p) {
    const Pin& pin = model_.pins[p];
    pin_changes_.col(static_cast<Eigen::Index>(p)) =
        (pin.position(time_end) - state.positions.col(pin.vertex)) / h -
        state.velocities.col(pin.vertex);
  }
  matrix_->reduce_to_parents(flat(forces_));
  matrix_->prescribe(pin_changes_, flat(forces_));
  SolveReport report;
  {
    const StageScope scope(observer_, Stage::factor);
    report = solver_->factorize(matrix_->lower());
  }
  if (!report.ok()) return report;
  {
    const StageScope scope(observer_, Stage::solve);
    report = solver_->solve(flat(forces_), flat(velocity_changes_));
  }
  state.velocities += velocity_changes_;
  state.positions += h * state.velocities;
  for (const Pin& pin : model_.pins) state.positions.col(pin.vertex) = pin.position(time_end);
  resolve_contacts(positions_begin_, state, time_end, h);
  return report;
}

}  // namespace pleat
