#include "core/sweep/sweep_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "core/base/check.h"
#include "core/base/formatted.h"
#include "core/dynamics/stepper_table.h"
#include "core/error/error_norms.h"
#include "core/error/run_comparison.h"
#include "core/linalg/make_linear_solver.h"
#include "core/reference/chain_reference.h"
#include "core/reference/closed_form_reference.h"
#include "core/scene/format/cloth_section.h"
#include "core/scene/format/scene_file.h"

namespace pleat {
namespace {

/// The settings of a family, which differ in level and method alone.
struct Family {
  explicit Family(std::size_t index) : first(index) {}

  std::size_t first;       // setting; uniform where any of them is
  bool is_planned = true;  // all meshes are plans
  std::set<int> levels;    // levels of uniform meshes
  double smallest_step = std::numeric_limits<double>::infinity();     // [s]
  double smallest_substep = std::numeric_limits<double>::infinity();  // [s], see reference_step

  void add(std::size_t index, const SweepSetting& setting) {
    const MethodOptions& method = setting.method;
    if (!setting.is_planned) levels.insert(setting.level);
    if (is_planned && !setting.is_planned) {
      is_planned = false;
      first = index;
    }
    smallest_step = std::min(smallest_step, method.step);
    if (method.stepper->solves_whole_substeps)
      smallest_substep = std::min(smallest_substep, method.step / method.substeps);
  }
  int finest() const { return levels.empty() ? 0 : *levels.rbegin(); }
};

/// A quarter of the smallest step: of the substeps of methods that solve for a whole one at once
/// (implicit, newton, projective), and of the steps where there is none of them.
double reference_step(const SweepPlan& plan, const Family& family) {
  constexpr double kShareOfSmallest = 0.25;
  constexpr double kLargestStep = 1.0 / 960;  // [s]
  if (plan.reference_step > 0) return plan.reference_step;
  const double smallest =
      std::isinf(family.smallest_substep) ? family.smallest_step : family.smallest_substep;
  return std::min(kLargestStep, kShareOfSmallest * smallest);
}

}  // namespace

const char* id_prefix(ReferenceKind kind) {
  constexpr const char* kPrefixes[] = {"converged", "same-mesh", "chain", "closed-form"};
  return kPrefixes[static_cast<std::size_t>(kind)];
}

MethodOptions exact_method(double step) {
  MethodOptions method;
  method.stepper = &steppers::kNewton;
  method.rule = NewtonRule::midpoint;
  method.step = step;
  method.solver = best_direct_solver();
  method.tolerance = kNewtonTolerance;
  return method;
}

namespace {

std::string run_phrase(const Scene& scene) {
  std::string phrase = std::string(scene.method.stepper->name) + " with " +
                       name(scene.method.solver) + ", level " + std::to_string(scene.level) +
                       ", step " + step_phrase(scene.method.step);
  return phrase;
}

/// True where the reference changes by less than this share of the cloth's size [1].
bool is_converged(const Scene& scene, double uncertainty) {
  constexpr double kShare = 0.01;
  return uncertainty <= kShare * scene.cloth->rest_diagonal();
}

/// Adds what halving one thing changed in a run of the scene.
void doubt(Reference& reference, const Scene& scene, const char* halved,
           std::span<const Sample> before) {
  const std::vector<double> changes = sample_distances(scene, before, reference.samples);
  const double change = root_mean_square(changes);
  reference.label.uncertainty = std::max(reference.label.uncertainty, change);
  for (std::size_t s = 0; s < changes.size(); ++s)
    reference.samples[s].uncertainty = std::max(reference.samples[s].uncertainty, changes[s]);
  reference.label.description +=
      formatted("; halving its %s changed it by %.3g mm", halved, 1e3 * change);
  reference.label.converged = is_converged(scene, reference.label.uncertainty);
}

/// `newton` with twice the recipe's step, to see what is still missing, and then with the step
/// itself. What the mesh leaves open is seen from the run on the coarser one.
class NewtonMaker : public ReferenceMaker {
 public:
  NewtonMaker(const ReferenceRecipe& recipe, std::vector<double> times, const Reference* coarser)
      : id_(recipe.id), times_(std::move(times)), scenes_{recipe.scene, recipe.scene} {
    scenes_.front().method.step *= 2;
    PLEAT_CHECK(recipe.coarser.has_value() == (coarser != nullptr),
                "the coarser reference is made");
    if (coarser == nullptr) return;
    if (coarser->samples.size() == times_.size())
      coarser_ = coarser->samples;
    else
      failure_ = coarser->label.description;
  }

  void advance(double budget) override {
    if (run_ == nullptr)
      run_ =
          std::make_unique<SampledRun>(scenes_[runs_.size()], times_, SampledRun::Parts::untimed);
    run_->advance(budget);
    if (!run_->done()) return;
    if (!run_->report().ok())  // wrong, if only once
      failure_ = run_phrase(scenes_[runs_.size()]) +
                 ", which could not be solved: " + run_->report().message;
    runs_.push_back(run_->samples());
    run_.reset();
  }

  bool done() const override { return !failure_.empty() || runs_.size() == scenes_.size(); }

  double progress() const override {
    const double at_hand = run_ != nullptr ? run_->progress() : 0;
    const double n_half_steps = scenes_.size() + 1;  // the first run has half of the steps
    const double passed = runs_.empty() ? at_hand : 1 + 2 * at_hand;
    return done() ? 1 : passed / n_half_steps;
  }

  Reference reference() const override {
    if (!failure_.empty()) return {{id_, failure_}, {}};
    const Scene& scene = scenes_.back();
    Reference reference{{id_, run_phrase(scene) + ", midpoint rule"}, runs_.back()};
    reference.content = content_id(scene);
    reference.label.uncertainty = 0;
    for (Sample& sample : reference.samples) sample.uncertainty = 0;
    doubt(reference, scene, "step", runs_.front());
    if (coarser_) doubt(reference, scene, "mesh", *coarser_);
    return reference;
  }

 private:
  std::string id_;
  std::vector<double> times_;
  std::array<Scene, 2> scenes_;  // scenes to run, the reference itself last
  std::optional<std::vector<Sample>> coarser_;
  std::vector<std::vector<Sample>> runs_;
  std::unique_ptr<SampledRun> run_;  // run at hand
  std::string failure_;
};

/// Makes a reference that takes seconds at most, in one slice.
class WholeMaker : public ReferenceMaker {
 public:
  explicit WholeMaker(std::function<Reference()> make) : make_(std::move(make)) {}

  void advance(double) override { reference_ = make_(); }
  bool done() const override { return reference_.has_value(); }
  double progress() const override { return done() ? 1 : 0; }
  Reference reference() const override { return *reference_; }

 private:
  std::function<Reference()> make_;
  std::optional<Reference> reference_;
};

/// Collects recipes, each once.
class Recipes {
 public:
  Recipes(const SweepPlan& plan, std::map<std::string, Family> families)
      : plan_(plan), families_(std::move(families)), times_(sweep_sample_times(plan.duration)) {}

  SettingReferences of(const SweepSetting& setting) {
    const Family& family = families_.at(setting.family);
    switch (plan_.reference) {
      case ReferenceKind::converged:
        return converged(family, setting);
      case ReferenceKind::same_mesh:
      case ReferenceKind::closed_form:
        return {add(plan_.reference, family, setting.level), {}};
      case ReferenceKind::rigid_chain:
        return {add(plan_.reference, family, family.finest()), {}};
    }
    return {};
  }

  std::vector<ReferenceRecipe> take() { return std::move(recipes_); }

 private:
  SettingReferences converged(const Family& family, const SweepSetting& setting) {
    const int finest = family.finest();
    const bool mesh_counts =
        family.levels.size() > 1 || plan_.reference_level.value_or(finest) > finest;
    if (!mesh_counts) return {add(ReferenceKind::same_mesh, family, finest), {}};
    const int level = plan_.reference_level.value_or(finer_than(family, finest));
    const std::size_t coarser = add(ReferenceKind::same_mesh, family, level - 1);
    SettingReferences references{add(ReferenceKind::converged, family, level, coarser), {}};
    if (!setting.is_planned) references.own = add(ReferenceKind::same_mesh, family, setting.level);
    return references;
  }

  /// The next level, or the same where cloth of the next has too many vertices.
  int finer_than(const Family& family, int level) const {
    try {
      check_level(plan_.scene_of(family.first), level + 1, "/refinement/level");
      return level + 1;
    } catch (const InputError&) {
      return level;
    }
  }

  std::size_t add(ReferenceKind kind, const Family& family, int level,
                  std::optional<std::size_t> coarser = {}) {
    ReferenceRecipe recipe{"", kind, plan_.scene_of(family.first), coarser};
    recipe.scene.level = level;
    const bool is_run = kind == ReferenceKind::converged || kind == ReferenceKind::same_mesh;
    recipe.scene.method = is_run ? exact_method(reference_step(plan_, family)) : MethodOptions();
    check_duration(plan_.duration, recipe.scene.method.step);
    recipe.id = reference_id(id_prefix(kind), recipe.scene, times_);
    const auto [place, is_new] = of_id_.try_emplace(recipe.id, recipes_.size());
    if (is_new) recipes_.push_back(std::move(recipe));
    return place->second;
  }

  const SweepPlan& plan_;
  std::map<std::string, Family> families_;
  std::vector<double> times_;
  std::vector<ReferenceRecipe> recipes_;
  std::map<std::string, std::size_t> of_id_;  // two families may be the same scene
};

}  // namespace

std::vector<std::size_t> SweepReferences::compared() const {
  std::set<std::size_t> indices;
  for (const SettingReferences& references : of_setting) {
    indices.insert(references.whole);
    if (references.own) indices.insert(*references.own);
  }
  return {indices.begin(), indices.end()};
}

SweepReferences sweep_references(const SweepPlan& plan) {
  std::map<std::string, Family> families;
  for (std::size_t s = 0; s < plan.settings.size(); ++s)
    families.try_emplace(plan.settings[s].family, Family(s)).first->second.add(s, plan.settings[s]);
  Recipes recipes(plan, std::move(families));
  SweepReferences references;
  for (const SweepSetting& setting : plan.settings)
    references.of_setting.push_back(recipes.of(setting));
  references.recipes = recipes.take();
  return references;
}

Reference checked_on_coarser(const ReferenceRecipe& recipe, Reference same_mesh,
                             const Reference& coarser) {
  PLEAT_CHECK(recipe.coarser && same_mesh.samples.size() == coarser.samples.size(),
              "both are whole runs");
  same_mesh.label.id = recipe.id;
  doubt(same_mesh, recipe.scene, "mesh", coarser.samples);
  return same_mesh;
}

std::unique_ptr<ReferenceMaker> make_reference_maker(const ReferenceRecipe& recipe,
                                                     const std::vector<double>& times,
                                                     const Reference* coarser) {
  switch (recipe.kind) {
    case ReferenceKind::converged:
    case ReferenceKind::same_mesh:
      return std::make_unique<NewtonMaker>(recipe, times, coarser);
    case ReferenceKind::rigid_chain:
      return std::make_unique<WholeMaker>(
          [scene = recipe.scene, times] { return chain_reference(scene, times); });
    case ReferenceKind::closed_form:
      return std::make_unique<WholeMaker>(
          [scene = recipe.scene, times] { return closed_form_reference(scene, times); });
  }
  return nullptr;
}

}  // namespace pleat
