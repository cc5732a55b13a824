#include "core/run/adaptive_run.h"

#include "core/base/check.h"
#include "core/dynamics/stepper_table.h"
#include "core/scene/rest_cloth.h"
#include "core/scene/tearing.h"

namespace pleat {
namespace {

const QuadCloth& quad_cloth(const Scene& scene) {
  const QuadCloth* cloth = scene.cloth->quads();
  if (cloth == nullptr)
    throw InputError("/cloth", "expected a sheet or a garment, got cloth that is not of quads");
  return *cloth;
}

}  // namespace

AdaptiveRun::AdaptiveRun(const Scene& scene, const DynamicOptions& options)
    : scene_(scene), base_(quad_cloth(scene).base_quads()), refinement_(base_, options) {
  expect_whole(scene);
  build(rest_cloth(scene_, 0));
  state_ = scene_state(cloth_);
  for (const Pin& pin : model_->pins) state_.positions.col(pin.vertex) = pin.position(0);
  if (model_->bend_friction) model_->bend_friction->restart(state_.positions);
}

void AdaptiveRun::build(RestCloth cloth) {
  stepper_.reset();  // it refers to the model
  cloth_ = std::move(cloth);
  model_ = std::make_unique<ClothModel>(scene_model(scene_, cloth_));
  gauge_ = gauge_edges(*mesh());
  stepper_ = make_stepper(*model_, scene_.method);
  stepper_->observe(observer_);
}

bool AdaptiveRun::adapt() {
  DynamicRefinement::Result adapted =
      refinement_.adapted({*mesh(), std::move(state_.positions), std::move(state_.velocities)});
  state_ = {std::move(adapted.state.positions), std::move(adapted.state.velocities)};
  if (adapted.n_split == 0 && adapted.n_merged == 0) return false;
  const std::optional<BendFriction> friction = model_->bend_friction;
  build(quad_cloth(scene_).at_rest(std::move(adapted.state.mesh)));
  if (friction) model_->bend_friction->take_moments(*friction, state_.positions);
  return true;
}

SolveReport AdaptiveRun::step() {
  SolveReport report = stepper_->advance(state_, time());
  if (!report.ends_run()) ++n_steps_;
  return report;
}

void AdaptiveRun::observe(PartObserver* observer) {
  observer_ = observer;
  stepper_->observe(observer);
}

}  // namespace pleat
