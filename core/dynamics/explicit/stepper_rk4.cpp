#include "core/dynamics/explicit/stepper_rk4.h"

#include "core/dynamics/explicit/stability_bound.h"
#include "core/model/elasticity.h"
#include "core/model/hanging_vertices.h"

namespace pleat {

StepperRk4::StepperRk4(ClothModel& model, const MethodOptions& options)
    : Stepper(model, options, stable_substeps(model, options)) {
  for (State& rates : rates_) rates.velocities.resize(3, model.n_vertices());
}

void StepperRk4::evaluate(State& state, double time, State& rates) {
  for (const Pin& pin : model_.pins) {
    state.positions.col(pin.vertex) = pin.position(time);
    state.velocities.col(pin.vertex) = pin.velocity(time);
  }
  place_between_parents(model_.hanging, state);
  rates.positions = state.velocities;
  if (model_.air) model_.air->set_time(time);
  set_external_forces(state, rates.velocities);
  const PartScope scope(observer_, Part::forces);
  add_internal_forces(model_, state.positions, state.velocities, rates.velocities);
  pull_to_parents(model_.hanging, rates.velocities);
  for (int i = 0; i < model_.n_vertices(); ++i)
    if (!model_.hangs(VertexId(i))) rates.velocities.col(i) /= model_.masses[i];
}

SolveReport StepperRk4::substep(State& state, double time_end, double h) {
  constexpr std::array<double, 4> kNodes = {0, 0.5, 0.5, 1};
  constexpr std::array<double, 4> kWeights = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
  positions_begin_ = state.positions;
  stage_ = state;
  for (std::size_t s = 0; s < kNodes.size(); ++s) {
    if (s > 0) {
      stage_.positions = state.positions + kNodes[s] * h * rates_[s - 1].positions;
      stage_.velocities = state.velocities + kNodes[s] * h * rates_[s - 1].velocities;
    }
    evaluate(stage_, time_end - h + kNodes[s] * h, rates_[s]);
  }
  for (std::size_t s = 0; s < kNodes.size(); ++s) {
    state.positions += kWeights[s] * h * rates_[s].positions;
    state.velocities += kWeights[s] * h * rates_[s].velocities;
  }
  for (const Pin& pin : model_.pins) {
    state.positions.col(pin.vertex) = pin.position(time_end);
    state.velocities.col(pin.vertex) = pin.velocity(time_end);
  }
  correct(state, time_end, h, model_.masses);
  return {};
}

}  // namespace pleat
