#include "core/measure/sweep_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/measure/chain_reference.h"
#include "core/scene/scene_file.h"

namespace pleat {
namespace {

bool solves_whole_substeps(const MethodOptions& method) {
  return method.stepper == StepperKind::implicit_euler || method.stepper == StepperKind::projective;
}

/// What the reference of a family depends on, of its settings.
struct Family {
  std::size_t first;                                                  // setting
  int level = 0;                                                      // the finest
  double smallest_step = std::numeric_limits<double>::infinity();     // [s]
  double smallest_substep = std::numeric_limits<double>::infinity();  // [s], see finest_scene

  void add(const SweepSetting& setting) {
    const MethodOptions& method = setting.method;
    level = std::max(level, setting.level);
    smallest_step = std::min(smallest_step, method.step);
    if (solves_whole_substeps(method))
      smallest_substep = std::min(smallest_substep, method.step / method.substeps);
  }
};

/// The scene of ReferenceKind::finest. "Smallest step" is the smallest substep of the methods that
/// solve for a whole substep at once (implicit, projective), and the smallest step where there is
/// none of them.
Scene finest_scene(const SweepPlan& plan, const Family& family) {
  constexpr double kShareOfSmallest = 0.25;
  // Of first order: with a longer step it would be further off than small substeps that it judges.
  constexpr double kLargestStep = 1.0 / 960;  // [s]
  const double smallest =
      std::isinf(family.smallest_substep) ? family.smallest_step : family.smallest_substep;
  Scene scene = plan.scene_of(family.first);
  scene.level = family.level;
  scene.method = MethodOptions{};
  scene.method.stepper = StepperKind::implicit_euler;
  scene.method.step = std::min(kLargestStep, kShareOfSmallest * smallest);
  scene.method.solver = best_direct_solver();
  return scene;
}

ReferenceRecipe recipe_for(const SweepPlan& plan, const Family& family,
                           const std::vector<double>& times) {
  ReferenceRecipe recipe{"", plan.reference, finest_scene(plan, family)};
  switch (plan.reference) {
    case ReferenceKind::finest:
      check_duration(plan.duration, recipe.scene.method.step);
      recipe.id = reference_id("finest", recipe.scene, times);
      break;
    case ReferenceKind::rigid_chain:
      recipe.scene.method = MethodOptions{};
      recipe.id = reference_id("chain", recipe.scene, times);
      break;
  }
  return recipe;
}

/// Settings of the same key are compared with the same reference.
const std::string& sharing_key(ReferenceKind kind, const SweepSetting& setting) {
  switch (kind) {
    case ReferenceKind::finest:
    case ReferenceKind::rigid_chain:
      return setting.family;
  }
  return setting.family;
}

/// A run of the recipe's scene.
class RunMaker : public ReferenceMaker {
 public:
  RunMaker(const ReferenceRecipe& recipe, const std::vector<double>& times)
      : id_(recipe.id), run_(recipe.scene, times, SampledRun::Parts::untimed) {}

  void advance(double budget) override { run_.advance(budget); }
  bool done() const override { return run_.done(); }
  double progress() const override { return run_.progress(); }

  Reference reference() const override {
    const Scene& scene = run_.simulation().scene();
    Reference reference{
        {id_,
         std::string(name(scene.method.stepper)) + " with " + name(scene.method.solver) +
             ", level " + std::to_string(scene.level) + ", step " + step_phrase(scene.method.step),
         false},
        run_.samples()};
    if (run_.failed())
      reference.label.description += ", which ended early: " + run_.report().message;
    return reference;
  }

 private:
  std::string id_;
  SampledRun run_;
};

/// The rigid chain takes seconds at most and is not cut.
class ChainMaker : public ReferenceMaker {
 public:
  ChainMaker(Scene scene, std::vector<double> times)
      : scene_(std::move(scene)), times_(std::move(times)) {}

  void advance(double) override { reference_ = chain_reference(scene_, times_); }
  bool done() const override { return !reference_.samples.empty(); }
  double progress() const override { return done() ? 1 : 0; }
  Reference reference() const override { return reference_; }

 private:
  Scene scene_;
  std::vector<double> times_;
  Reference reference_;
};

}  // namespace

SweepReferences sweep_references(const SweepPlan& plan) {
  std::map<std::string, Family> families;
  for (std::size_t s = 0; s < plan.settings.size(); ++s)
    families.try_emplace(plan.settings[s].family, Family{s}).first->second.add(plan.settings[s]);

  const std::vector<double> times = sweep_sample_times(plan.duration);
  SweepReferences references;
  std::map<std::string, std::size_t> of_key;
  std::map<std::string, std::size_t> of_id;  // two keys may stand for the same scene
  for (const SweepSetting& setting : plan.settings) {
    const std::string& key = sharing_key(plan.reference, setting);
    if (of_key.count(key) == 0) {
      ReferenceRecipe recipe = recipe_for(plan, families.at(setting.family), times);
      const auto [place, is_new] = of_id.try_emplace(recipe.id, references.recipes.size());
      if (is_new) references.recipes.push_back(std::move(recipe));
      of_key[key] = place->second;
    }
    references.of_setting.push_back(of_key.at(key));
  }
  return references;
}

std::unique_ptr<ReferenceMaker> make_reference_maker(const ReferenceRecipe& recipe,
                                                     const std::vector<double>& times) {
  switch (recipe.kind) {
    case ReferenceKind::finest:
      return std::make_unique<RunMaker>(recipe, times);
    case ReferenceKind::rigid_chain:
      return std::make_unique<ChainMaker>(recipe.scene, times);
  }
  return nullptr;
}

}  // namespace pleat
