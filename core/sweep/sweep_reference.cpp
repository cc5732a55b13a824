#include "core/sweep/sweep_reference.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "core/dynamics/stepper_table.h"
#include "core/error/error_norms.h"
#include "core/error/run_comparison.h"
#include "core/reference/chain_reference.h"
#include "core/reference/closed_form_reference.h"
#include "core/scene/scene_file.h"

namespace pleat {
namespace {

/// The settings that share a reference, as far as it depends on them.
struct Group {
  std::size_t first;                                                  // setting
  int level = 0;                                                      // the finest
  double smallest_step = std::numeric_limits<double>::infinity();     // [s]
  double smallest_substep = std::numeric_limits<double>::infinity();  // [s], see reference_step

  void add(const SweepSetting& setting) {
    const MethodOptions& method = setting.method;
    level = std::max(level, setting.level);
    smallest_step = std::min(smallest_step, method.step);
    if (method.stepper->solves_whole_substeps)
      smallest_substep = std::min(smallest_substep, method.step / method.substeps);
  }
};

/// A quarter of the smallest step: of the substeps of methods that solve for a whole one at once
/// (implicit, newton, projective), and of the steps where there is none of them.
double reference_step(const Group& group) {
  constexpr double kShareOfSmallest = 0.25;
  // With a longer step `finest`, of first order, would be further off than small substeps that it
  // judges.
  constexpr double kLargestStep = 1.0 / 960;  // [s]
  const double smallest =
      std::isinf(group.smallest_substep) ? group.smallest_step : group.smallest_substep;
  return std::min(kLargestStep, kShareOfSmallest * smallest);
}

MethodOptions reference_method(const SweepPlan& plan, const Group& group) {
  MethodOptions method;
  switch (plan.reference) {
    case ReferenceKind::finest:
      method.stepper = &steppers::implicit_euler;
      break;
    case ReferenceKind::newton:
    case ReferenceKind::same_mesh:
      return exact_method(plan.reference_step > 0 ? plan.reference_step : reference_step(group));
    case ReferenceKind::rigid_chain:
    case ReferenceKind::closed_form:
      return method;  // they do not depend on it
  }
  method.step = reference_step(group);
  method.solver = best_direct_solver();
  return method;
}

}  // namespace

const char* id_prefix(ReferenceKind kind) {
  switch (kind) {
    case ReferenceKind::finest:
      return "finest";
    case ReferenceKind::rigid_chain:
      return "chain";
    case ReferenceKind::newton:
      return "newton";
    case ReferenceKind::same_mesh:
      return "same-mesh";
    case ReferenceKind::closed_form:
      return "closed-form";
  }
  return "";
}

MethodOptions exact_method(double step) {
  MethodOptions method;
  method.stepper = &steppers::newton;
  method.rule = NewtonRule::midpoint;
  method.step = step;
  method.solver = best_direct_solver();
  method.tolerance = kNewtonTolerance;
  return method;
}

namespace {

ReferenceRecipe recipe_for(const SweepPlan& plan, const Group& group,
                           const std::vector<double>& times) {
  ReferenceRecipe recipe{"", plan.reference, plan.scene_of(group.first)};
  recipe.scene.level = group.level;
  recipe.scene.method = reference_method(plan, group);
  check_duration(plan.duration, recipe.scene.method.step);
  recipe.id = reference_id(id_prefix(plan.reference), recipe.scene, times);
  return recipe;
}

/// Settings of the same key are compared with the same reference.
std::string sharing_key(ReferenceKind kind, const SweepSetting& setting) {
  const bool is_of_level = kind == ReferenceKind::same_mesh || kind == ReferenceKind::closed_form;
  return is_of_level ? setting.family + "/" + std::to_string(setting.level) : setting.family;
}

std::string run_phrase(const Scene& scene) {
  std::string phrase = std::string(scene.method.stepper->name) + " with " +
                       name(scene.method.solver) + ", level " + std::to_string(scene.level) +
                       ", step " + step_phrase(scene.method.step);
  return phrase;
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
    Reference reference{{id_, run_phrase(run_.simulation().scene())}, run_.samples()};
    if (run_.failed())
      reference.label.description += ", which ended early: " + run_.report().message;
    return reference;
  }

 private:
  std::string id_;
  SampledRun run_;
};

/// `newton` with the recipe's step and, to see what is still missing, with twice that step and, as
/// far as the mesh is to count, on the next coarser mesh.
class NewtonMaker : public ReferenceMaker {
 public:
  NewtonMaker(const ReferenceRecipe& recipe, std::vector<double> times)
      : id_(recipe.id),
        times_(std::move(times)),
        mesh_counts_(recipe.kind == ReferenceKind::newton),
        checks_mesh_(mesh_counts_ && recipe.scene.level > 0) {
    scenes_.push_back(recipe.scene);
    scenes_.back().method.step *= 2;
    if (checks_mesh_) {
      scenes_.push_back(recipe.scene);
      --scenes_.back().level;
    }
    scenes_.push_back(recipe.scene);
  }

  void advance(double budget) override {
    if (run_ == nullptr)
      run_ =
          std::make_unique<SampledRun>(scenes_[runs_.size()], times_, SampledRun::Parts::untimed);
    run_->advance(budget);
    if (!run_->done()) return;
    if (!run_->report().ok()) failure_ = run_->report().message;  // wrong, if only once
    runs_.push_back(run_->samples());
    run_.reset();
  }

  bool done() const override { return !failure_.empty() || runs_.size() == scenes_.size(); }

  double progress() const override {
    const double at_hand = run_ != nullptr ? run_->progress() : 0;
    return done() ? 1
                  : (static_cast<double>(runs_.size()) + at_hand) /
                        static_cast<double>(scenes_.size());
  }

  Reference reference() const override {
    const Scene& scene = scenes_.back();
    Reference reference{{id_, run_phrase(scene) + ", midpoint rule"}, runs_.back()};
    if (!failure_.empty()) {
      reference.samples.clear();
      reference.label.description += ", which could not be solved: " + failure_;
      return reference;
    }
    reference.content = content_id(scene);
    // On the coarsest mesh there is no coarser one to see what a mesh leaves open.
    reference.label.converged = checks_mesh_ || !mesh_counts_;
    if (!reference.label.converged) reference.label.description += "; its mesh is not checked";
    reference.label.uncertainty = 0;
    for (Sample& sample : reference.samples) sample.uncertainty = 0;
    for (std::size_t r = 0; r + 1 < runs_.size(); ++r) {
      const std::vector<double> changes = sample_distances(scene, runs_[r], runs_.back());
      const double change = root_mean_square(changes);
      reference.label.uncertainty = std::max(reference.label.uncertainty, change);
      for (std::size_t s = 0; s < changes.size(); ++s)
        reference.samples[s].uncertainty = std::max(reference.samples[s].uncertainty, changes[s]);
      char phrase[80];
      std::snprintf(phrase, sizeof phrase, "; halving its %s changed it by %.3g mm",
                    r == 0 ? "step" : "mesh", 1e3 * change);
      reference.label.description += phrase;
    }
    return reference;
  }

 private:
  std::string id_;
  std::vector<double> times_;
  bool mesh_counts_;
  bool checks_mesh_;
  std::vector<Scene> scenes_;  // to run, the reference itself last
  std::vector<std::vector<Sample>> runs_;
  std::unique_ptr<SampledRun> run_;  // at hand
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

}  // namespace

SweepReferences sweep_references(const SweepPlan& plan) {
  std::map<std::string, Group> groups;
  for (std::size_t s = 0; s < plan.settings.size(); ++s)
    groups.try_emplace(sharing_key(plan.reference, plan.settings[s]), Group{s})
        .first->second.add(plan.settings[s]);

  const std::vector<double> times = sweep_sample_times(plan.duration);
  SweepReferences references;
  std::map<std::string, std::size_t> of_key;
  std::map<std::string, std::size_t> of_id;  // two keys may stand for the same scene
  for (const SweepSetting& setting : plan.settings) {
    const std::string key = sharing_key(plan.reference, setting);
    if (of_key.count(key) == 0) {
      ReferenceRecipe recipe = recipe_for(plan, groups.at(key), times);
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
    case ReferenceKind::newton:
    case ReferenceKind::same_mesh:
      return std::make_unique<NewtonMaker>(recipe, times);
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
