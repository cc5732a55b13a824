#include "core/dynamics/explicit/stepper_explicit.h"

#include "core/dynamics/explicit/stability_bound.h"
#include "core/model/elasticity.h"
#include "core/model/hanging_vertices.h"

namespace pleat {

StepperExplicit::StepperExplicit(ClothModel& model, const MethodOptions& options)
    : Stepper(model, options, stable_substeps(model, options)), forces_(3, model.n_vertices()) {}

SolveReport StepperExplicit::substep(State& state, double time_end, double h) {
  positions_begin_ = state.positions;
  set_external_forces(state, forces_);
  {
    const PartScope scope(observer_, Part::forces);
    add_internal_forces(model_, state.positions, state.velocities, forces_);
    pull_to_parents(model_.hanging, forces_);
  }
  {
    const PartScope scope(observer_, Part::solve);
    if (options().euler == EulerRule::forward) state.positions += h * state.velocities;
    for (int i = 0; i < model_.n_vertices(); ++i)
      if (!model_.hangs(VertexId(i)))
        state.velocities.col(i) += h / model_.masses[i] * forces_.col(i);
    for (const Pin& pin : model_.pins)
      state.velocities.col(pin.vertex) =
          (pin.position(time_end) - positions_begin_.col(pin.vertex)) / h;
    if (options().euler == EulerRule::symplectic) state.positions += h * state.velocities;
    for (const Pin& pin : model_.pins) state.positions.col(pin.vertex) = pin.position(time_end);
  }
  correct(state, time_end, h, model_.masses);
  return {};
}

}  // namespace pleat
