#include "cli/bare_cloth.h"

#include "core/base/check.h"
#include "core/dynamics/stepper_table.h"
#include "core/run/scene_model.h"
#include "core/scene/rest_cloth.h"

namespace pleat {
namespace {

/// The model without what a simulation or a step could ask for beside springs and weight.
ClothModel bare(ClothModel whole) {
  ClothModel model;
  model.masses = std::move(whole.masses);
  model.springs = std::move(whole.springs);
  model.damping_direction = whole.damping_direction;
  model.gravity = whole.gravity;
  model.pins = std::move(whole.pins);
  model.rest_coordinates = std::move(whole.rest_coordinates);
  return model;
}

bool has_more_than_springs(const ClothModel& model) {
  return !model.is_plain_spring_lattice() || !model.bends.empty() || !model.hanging.empty() ||
         model.air || model.contact || model.self_contact;
}

}  // namespace

BareCloth::BareCloth(const Scene& scene) : step_(scene.method.step) {
  const RestCloth cloth = rest_cloth(scene);
  ClothModel whole = scene_model(scene, cloth);
  if (has_more_than_springs(whole))
    throw InputError("--bare", "expected a scene of springs, pins and weight alone, got more");
  model_ = bare(std::move(whole));
  gauge_ = gauge_edges(cloth);
  state_ = scene_state(cloth);
  for (const Pin& pin : model_.pins) state_.positions.col(pin.vertex) = pin.position(0);
  stepper_ = make_stepper(model_, scene.method);
}

SolveReport BareCloth::step() {
  SolveReport report = stepper_->advance(state_, time());
  if (!report.ends_run()) ++n_steps_;
  return report;
}

}  // namespace pleat
