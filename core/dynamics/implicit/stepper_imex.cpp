#include "core/dynamics/implicit/stepper_imex.h"

#include <string>

#include "core/base/check.h"
#include "core/model/elasticity.h"

namespace pleat {
namespace {

bool has_share(const ClothModel& model, const MethodOptions& options, int substeps) {
  return explicit_share(model, options.step / substeps) >= options.explicit_share;
}

}  // namespace

int imex_substeps(const ClothModel& model, const MethodOptions& options) {
  int too_few = options.substeps - 1;
  int enough = options.substeps;
  if (options.explicit_share == 0) return enough;
  if (options.split == ImplicitSplit::structural)
    throw InputError("/method/explicit_share",
                     "expected no such key beside \"split\": \"structural\", which takes the same "
                     "springs whatever the substeps");
  while (!has_share(model, options, enough)) {
    if (enough > kMaxSubsteps / 2)
      throw InputError("/method/explicit_share",
                       "expected a share that " + std::to_string(kMaxSubsteps) +
                           " substeps or fewer make explicit, got one that needs more");
    too_few = enough;
    enough *= 2;
  }
  while (enough - too_few > 1) {
    const int middle = too_few + (enough - too_few) / 2;
    (has_share(model, options, middle) ? enough : too_few) = middle;
  }
  return enough;
}

StepperImex::StepperImex(ClothModel& model, const MethodOptions& options)
    : Stepper(model, options, imex_substeps(model, options), ContactMemory::last_substep),
      solve_(model, make_solver(options, kMaxSolverIterations)),
      forces_(3, model.n_vertices()),
      positions_begin_(3, model.n_vertices()) {
  if (model_.contact) hold_.emplace(model_);
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
  set_external_forces(state, forces_);
  assemble(state, h);
  add_air_resistance(h, *matrix_);
  matrix_->reduce_to_parents(flat(forces_));
  if (hold_) {
    const StageScope scope(observer_, Stage::contact);
    hold_->set_resistances(*matrix_);
    hold_->choose(touches_, state, h);
    hold_->add(state.velocities, *matrix_, forces_);
  }
  SolveReport report = solve_.advance(*matrix_, forces_, state, time_end, h, observer_);
  if (report.ends_run()) return report;
  if (hold_) hold_->add_forces(state.velocities, h, contact_forces_);
  correct(positions_begin_, state, time_end, h, hold_ ? hold_->resistances() : model_.masses);
  return report;
}

}  // namespace pleat
