#include "core/measure/sweep_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/check.h"
#include "core/scene/cloth_section.h"
#include "core/scene/method_section.h"
#include "core/scene/scene_file.h"

namespace pleat {
namespace {

constexpr int kMaxRepeats = 1000;
constexpr std::array<Word<ReferenceKind>, 2> kReferenceWords = {
    {{"finest", ReferenceKind::finest}, {"rigid_chain", ReferenceKind::rigid_chain}}};

bool solves_whole_substeps(const MethodOptions& method) {
  return method.stepper == StepperKind::implicit_euler || method.stepper == StepperKind::projective;
}

Scene read_plan_scene(const JsonReader& reader, const Json& json, const FabricLibrary& fabrics) {
  try {
    return read_scene(json.dump(), fabrics);
  } catch (const InputError& error) {
    throw InputError(reader.pointer() + error.where(), error.what());
  }
}

std::vector<int> read_levels(const JsonReader& reader, const Scene& scene) {
  std::vector<int> levels;
  for (const JsonReader& level : reader.elements()) {
    levels.push_back(static_cast<int>(level.integer(0, kMaxLevel)));
    check_level(scene, levels.back(), level.pointer());
  }
  if (levels.empty()) reader.fail("at least one level");
  return levels;
}

}  // namespace

SweepPlan read_sweep_plan(std::string_view json_text, const FabricLibrary& fabrics) {
  const Json json = parse_json(json_text);
  const JsonReader reader(json);
  reader.allow_keys({"scene", "levels", "methods", "duration_s", "repeats", "reference"});
  const JsonReader scene = reader.at("scene");
  SweepPlan plan;
  plan.scene = read_plan_scene(scene, json.at("scene"), fabrics);
  plan.duration = plan.scene.duration;
  plan.levels = {plan.scene.level};
  plan.methods = {plan.scene.method};
  if (const auto levels = reader.find("levels")) plan.levels = read_levels(*levels, plan.scene);
  if (const auto methods = reader.find("methods")) {
    plan.methods.clear();
    for (const JsonReader& method : methods->elements())
      read_method(method, plan.methods.emplace_back());
    if (plan.methods.empty()) methods->fail("at least one method");
  }
  if (const auto duration = reader.find("duration_s")) plan.duration = duration->number(kPositive);
  if (const auto repeats = reader.find("repeats"))
    plan.n_repeats = static_cast<int>(repeats->integer(1, kMaxRepeats));
  if (const auto reference = reader.find("reference"))
    plan.reference = reference->word(kReferenceWords);
  check_duration(plan);
  return plan;
}

std::string write_sweep_plan(const SweepPlan& plan) {
  Json methods = Json::array();
  for (const MethodOptions& method : plan.methods) methods.push_back(json_method(method));
  return format_json({{"scene", parse_json(write_scene(plan.scene))},
                      {"levels", plan.levels},
                      {"methods", methods},
                      {"duration_s", plan.duration},
                      {"repeats", plan.n_repeats},
                      {"reference", word_for(kReferenceWords, plan.reference)}});
}

void check_duration(const SweepPlan& plan) {
  for (const MethodOptions& method : plan.methods) check_duration(plan.duration, method.step);
  if (plan.reference == ReferenceKind::finest)
    check_duration(plan.duration, finest_scene(plan).method.step);
}

std::vector<double> sweep_sample_times(double duration) {
  constexpr int kSamples = 10;
  std::vector<double> times;
  for (int s = 1; s <= kSamples; ++s) times.push_back(duration * s / kSamples);
  return times;
}

Scene finest_scene(const SweepPlan& plan) {
  constexpr double kShareOfSmallest = 0.25;
  // Of first order: with a longer step it would be further off than small substeps that it judges.
  constexpr double kLargestStep = 1.0 / 960;  // [s]
  double smallest = std::numeric_limits<double>::infinity();
  for (const MethodOptions& method : plan.methods)
    if (solves_whole_substeps(method)) smallest = std::min(smallest, method.step / method.substeps);
  if (std::isinf(smallest))
    for (const MethodOptions& method : plan.methods) smallest = std::min(smallest, method.step);

  Scene scene = plan.scene;
  scene.level = *std::max_element(plan.levels.begin(), plan.levels.end());
  scene.method = MethodOptions{};
  scene.method.stepper = StepperKind::implicit_euler;
  scene.method.step = std::min(kLargestStep, kShareOfSmallest * smallest);
  scene.method.solver = best_direct_solver();
  return scene;
}

}  // namespace pleat
