#include "core/run/plan_maker.h"

#include <string>

#include "core/files/json_text.h"
#include "core/refinement/mesh_match.h"

namespace pleat {
namespace {

constexpr double kRounding = 1e-9;  // share of a frame

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

/// The name of an example, and what has to be the same for all.
std::string description(const Scene& scene) {
  return abbreviated(Json(scene.name)) + " at level " + std::to_string(scene.level) + " with " +
         std::to_string(scene.cloth->n_vertices(0)) + " unrefined vertices";
}

/// Says of what is wrong which example has it.
template <class Work>
void of_example(std::size_t example, Work&& work) {
  try {
    work();
  } catch (const InputError& error) {
    throw ExampleError(example, error);
  }
}

/// Throws InputError unless plans can be made of both together.
void check_alike(const Scene& scene, const Scene& first) {
  if (base_fingerprint(example_base(scene)) != base_fingerprint(example_base(first)) ||
      scene.level != first.level)
    throw InputError("/cloth", "expected examples of one cloth at one level, got " +
                                   description(scene) + " beside " + description(first));
}

std::vector<Scene> checked(std::vector<Scene> examples) {
  PLEAT_CHECK(!examples.empty(), "a plan has an example");
  return examples;
}

}  // namespace

double settled_time(const Scene& scene) {
  constexpr double kSettling = 1.0;  // [s] after a body has begun to move as it will
  return scene.body ? scene.body->playback.blend_time + kSettling : 0;
}

PlanMaker::PlanMaker(std::vector<Scene> examples, const PlanRecipe& recipe)
    : scenes_(checked(std::move(examples))), recipe_(recipe), study_(scenes_.front()) {
  PLEAT_CHECK(recipe.frame_time > 0, "frames follow one another");
  recipe.patterns.validate();
  check_plan_options(recipe.plan, recipe.patterns.n_patterns, study_.base(), scenes_.front().level);
  for (std::size_t k = 1; k < scenes_.size(); ++k)
    of_example(k, [&] { check_alike(scenes_[k], scenes_.front()); });
  cost_.frame_time = recipe.frame_time;
  begin_example();
}

void PlanMaker::begin_example() {
  const Scene& scene = scenes_[study_.n_examples()];
  of_example(study_.n_examples(), [&] {
    run_ = std::make_unique<SampledRun>(scene, frame_times(scene, recipe_),
                                        SampledRun::Parts::watched);
  });
}

void PlanMaker::end_example() {
  const Scene& scene = scenes_[study_.n_examples()];
  if (run_->failed())
    throw InputError("", "expected an example that runs to its end, got \"" + scene.name +
                             "\": " + run_->report().message);
  warnings_.push_back(run_->warnings());
  const std::size_t first_frame = study_.frames().size();
  for (const Sample& sample : run_->samples()) study_.add_frame(sample.positions);
  study_.add_example(scene.name, study_.features(first_frame), recipe_.patterns);
}

RefinementPlan PlanMaker::plan_for(const PlanOptions& options) const {
  PLEAT_CHECK(study_.n_examples() == scenes_.size(), "a plan is made of whole examples");
  return study_.plan(options);
}

void PlanMaker::advance(double budget) {
  if (done_) return;
  const Stopwatch running;
  run_->advance(budget);
  cost_.example_seconds += running.elapsed();
  if (!run_->done()) return;
  const Stopwatch planning;
  of_example(study_.n_examples(), [&] { end_example(); });
  if (study_.n_examples() < scenes_.size()) {
    begin_example();
  } else {
    run_.reset();
    plan_ = plan_for(recipe_.plan);
    cost_.n_frames = static_cast<int>(study_.frames().size());
    cost_.megabytes = 24e-6 * static_cast<double>(study_.fine().n_vertices()) * cost_.n_frames;
    done_ = true;
  }
  cost_.planning_seconds += planning.elapsed();
}

double PlanMaker::progress() const {
  if (done_) return 1;
  return (static_cast<double>(study_.n_examples()) + run_->progress()) /
         static_cast<double>(scenes_.size());
}

}  // namespace pleat
