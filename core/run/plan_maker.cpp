#include "core/run/plan_maker.h"

#include <cmath>
#include <string>

#include "core/base/check.h"
#include "core/files/json_text.h"
#include "core/refinement/fit_monitor.h"
#include "core/refinement/mesh_match.h"
#include "core/scene/cloth_section.h"

namespace pleat {
namespace {

constexpr double kRounding = 1e-9;  // of a frame

std::vector<double> frame_times(const Scene& scene, const PlanRecipe& recipe) {
  std::vector<double> times;
  for (int k = 1;; ++k) {
    const double time = k * recipe.frame_time;
    if (time > scene.duration + kRounding * recipe.frame_time) break;
    if (time > recipe.begin) times.push_back(time);
  }
  if (times.size() < 2)
    throw InputError("/duration_s", "expected at least two frames after " +
                                        Json(recipe.begin).dump() + " s, got " +
                                        std::to_string(times.size()));
  return times;
}

QuadMesh example_base(const Scene& scene) {
  std::optional<QuadMesh> base = base_quads(scene);
  if (!base)
    throw InputError("/cloth", "expected a sheet or a garment, got cloth that is not of quads");
  if (scene.plan)
    throw InputError("/refinement/plan", "expected an example refined uniformly, got a plan");
  if (scene.level < 1)
    throw InputError("/refinement/level", "expected an example refined once at least, got level 0");
  return *std::move(base);
}

/// Of an example: its name, and what has to be the same.
std::string description(const Scene& scene) {
  return abbreviated(Json(scene.name)) + " at level " + std::to_string(scene.level) + " with " +
         std::to_string(scene.cloth->n_vertices(0)) + " unrefined vertices";
}

}  // namespace

double settled_time(const Scene& scene) {
  constexpr double kSettling = 1.0;  // [s] after a figure has begun to move as it will
  return scene.figure ? scene.figure->playback.blend_time + kSettling : 0;
}

PlanMaker::PlanMaker(std::vector<Scene> examples, const PlanRecipe& recipe)
    : scenes_(std::move(examples)), recipe_(recipe) {
  PLEAT_CHECK(!scenes_.empty() && recipe.frame_time > 0, "a plan has an example with frames");
  base_ = example_base(scenes_.front());
  recipe.patterns.validate();
  check_plan_options(recipe.plan, recipe.patterns.n_patterns, base_, scenes_.front().level);
  fine_ = base_;
  fine_.refine_uniformly(scenes_.front().level);
  for (const Scene& scene : scenes_)
    if (base_fingerprint(example_base(scene)) != base_fingerprint(base_) ||
        scene.level != scenes_.front().level)
      throw InputError("/cloth", "expected examples of one cloth at one level, got " +
                                     description(scene) + " beside " +
                                     description(scenes_.front()));
  cost_.frame_time = recipe.frame_time;
  begin_example();
}

void PlanMaker::begin_example() {
  const Scene& scene = scenes_[examples_.size()];
  run_ =
      std::make_unique<SampledRun>(scene, frame_times(scene, recipe_), SampledRun::Parts::untimed);
}

void PlanMaker::end_example() {
  const Scene& scene = scenes_[examples_.size()];
  if (run_->failed())
    throw InputError("", "expected an example that runs to its end, got \"" + scene.name +
                             "\": " + run_->report().message);
  BendFeatureSum sum(fine_);
  for (const Sample& sample : run_->samples()) {
    sum.add(sample.positions);
    frames_.push_back(sample.positions);
  }
  const BendFeatures features = sum.features();
  examples_.push_back({scene.name, features, bend_patterns(features, recipe_.patterns)});
}

RefinementPlan PlanMaker::plan_for(const PlanOptions& options) const {
  PLEAT_CHECK(examples_.size() == scenes_.size(), "a plan is made of whole examples");
  RefinementPlan plan = refinement_plan(base_, fine_, examples_, options);
  ExampleEnvelope envelope(planned_mesh(base_, plan), fine_, plan);
  for (const Positions& frame : frames_) envelope.add(frame);
  plan.curvature_limits = envelope.limits();
  return plan;
}

void PlanMaker::advance(double budget) {
  if (done_) return;
  const Stopwatch running;
  run_->advance(budget);
  cost_.example_seconds += running.elapsed();
  if (!run_->done()) return;
  const Stopwatch planning;
  end_example();
  if (examples_.size() < scenes_.size()) {
    begin_example();
  } else {
    run_.reset();
    plan_ = plan_for(recipe_.plan);
    cost_.n_frames = static_cast<int>(frames_.size());
    cost_.megabytes = 24e-6 * static_cast<double>(fine_.n_vertices()) * cost_.n_frames;
    done_ = true;
  }
  cost_.planning_seconds += planning.elapsed();
}

double PlanMaker::progress() const {
  if (done_) return 1;
  return (static_cast<double>(examples_.size()) + run_->progress()) /
         static_cast<double>(scenes_.size());
}

}  // namespace pleat
