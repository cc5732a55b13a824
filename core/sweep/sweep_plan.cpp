#include "core/sweep/sweep_plan.h"

#include <array>
#include <set>

#include "core/base/check.h"
#include "core/reference/reference.h"
#include "core/scene/format/scene_override.h"

namespace pleat {
namespace {

constexpr int kMaxRepeats = 1000;
constexpr const char* kDuration = "/duration_s";  // key of the scene and of the plan
constexpr std::array<Word<ReferenceKind>, 4> kReferenceWords = {
    {{"converged", ReferenceKind::converged},
     {"same_mesh", ReferenceKind::same_mesh},
     {"rigid_chain", ReferenceKind::rigid_chain},
     {"closed_form", ReferenceKind::closed_form}}};

/// A value for the scene and the place in the plan that it stands at.
struct PlannedChange {
  SceneOverride change;
  std::string where;
};
using PlannedChanges = std::vector<PlannedChange>;

Json changed_scene(Json scene, const Json& changes, StepperTable steppers) {
  std::vector<SceneOverride> overrides;
  for (const auto& change : changes.items()) overrides.push_back({change.key(), change.value()});
  override_scene(scene, overrides, steppers);
  return scene;
}

/// True when one of two pointers leads into what the other one leads to.
bool overlap(const std::string& a, const std::string& b) {
  const std::string& shorter = a.size() < b.size() ? a : b;
  const std::string& longer = a.size() < b.size() ? b : a;
  return longer.rfind(shorter, 0) == 0 &&
         (longer.size() == shorter.size() || longer[shorter.size()] == '/');
}

/// An error in a setting's scene, told at the change of the plan that it comes from: one that leads
/// there, else the last one.
[[noreturn]] void throw_at_change(const InputError& error, const PlannedChanges& changes) {
  const PlannedChange* nearest = nullptr;
  for (const PlannedChange& planned : changes)
    if (overlap(planned.change.pointer, error.where()) &&
        (nearest == nullptr || planned.change.pointer.size() > nearest->change.pointer.size()))
      nearest = &planned;
  if (nearest == nullptr) nearest = &changes.back();
  throw InputError(nearest->where, std::string("in the scene, ") + error.what());
}

/// The one list of changes that a member of the plan's "settings" is.
PlannedChanges read_setting(const JsonReader& reader) {
  PlannedChanges changes;
  for (const auto& [pointer, value] : reader.members())
    changes.push_back({{pointer, value.json()}, value.pointer()});
  return changes;
}

std::vector<PlannedChanges> read_settings(const JsonReader& reader) {
  std::vector<PlannedChanges> settings;
  for (const JsonReader& entry : reader.elements()) settings.push_back(read_setting(entry));
  if (settings.empty()) reader.fail("at least one setting");
  return settings;
}

[[noreturn]] void throw_too_many(const std::string& where) {
  throw InputError(where,
                   "expected at most " + std::to_string(kMaxSettings) + " settings, got more");
}

/// Every setting of `outer` with each of the values, which change first.
std::vector<PlannedChanges> times_values(const std::vector<PlannedChanges>& outer,
                                         const std::string& pointer, const JsonReader& values) {
  const std::vector<JsonReader> elements = values.elements();
  if (elements.empty()) values.fail("at least one value");
  if (outer.size() * elements.size() > kMaxSettings) throw_too_many("/grid");
  std::set<std::string> known;
  for (const JsonReader& value : elements)
    if (!known.insert(value.json().dump()).second)
      throw InputError(value.pointer(),
                       "expected each value once, got " + abbreviated(value.json()) + " twice");
  std::vector<PlannedChanges> product;
  for (const PlannedChanges& changes : outer)
    for (const JsonReader& value : elements) {
      product.push_back(changes);
      product.back().push_back({{pointer, value.json()}, value.pointer()});
    }
  return product;
}

std::vector<PlannedChanges> read_grid(const JsonReader& reader) {
  std::vector<PlannedChanges> grid(1);
  for (const auto& [pointer, values] : reader.members()) grid = times_values(grid, pointer, values);
  return grid;
}

std::vector<PlannedChanges> combined(const std::vector<PlannedChanges>& grid,
                                     const std::vector<PlannedChanges>& settings) {
  if (grid.size() * settings.size() > kMaxSettings) throw_too_many("/settings");
  std::vector<PlannedChanges> all;
  for (const PlannedChanges& point : grid)
    for (const PlannedChanges& setting : settings) {
      all.push_back(point);
      all.back().insert(all.back().end(), setting.begin(), setting.end());
    }
  return all;
}

Json changes_json(const PlannedChanges& changes) {
  Json json = Json::object();
  for (const PlannedChange& planned : changes) {
    if (planned.change.pointer == kDuration)
      throw InputError(planned.where,
                       "expected a change of anything but the duration, which all settings share");
    if (!json.emplace(planned.change.pointer, Json(planned.change.value)).second)
      throw InputError(planned.where, "expected a pointer that the grid does not have, got " +
                                          abbreviated(Json(planned.change.pointer)));
  }
  return json;
}

/// Equal for all settings that differ in level and method alone.
std::string family_of(Json scene) {
  scene.erase("method");
  scene.erase("refinement");
  return content_hash(scene.dump());
}

SweepSetting make_setting(const SweepPlan& plan, const PlannedChanges& planned) {
  SweepSetting setting;
  setting.changes = changes_json(planned);
  try {
    const Json json = changed_scene(plan.scene, setting.changes, plan.steppers);
    const Scene scene = plan.read(JsonReader(json));
    setting.level = scene.level;
    setting.is_planned = scene.plan.has_value();
    setting.method = scene.method;
    setting.family = family_of(json);
    setting.n_vertices = static_cast<double>(scene.cloth->n_vertices(scene.level));
  } catch (const InputError& error) {
    if (planned.empty()) throw InputError("/scene" + error.where(), error.sentence());
    throw_at_change(error, planned);
  }
  return setting;
}

/// The scene's own faults, before any setting's.
void read_plan_scene(const JsonReader& reader, SweepPlan& plan) {
  const auto duration = reader.find("duration_s");
  if (duration && plan.scene.is_object()) plan.scene["duration_s"] = duration->number(kPositive);
  try {
    const Scene scene = plan.read(JsonReader(plan.scene));
    plan.name = scene.name;
    plan.duration = scene.duration;
  } catch (const InputError& error) {
    const bool is_plans_own = duration && error.where() == kDuration;
    throw InputError((is_plans_own ? "" : "/scene") + error.where(), error.sentence());
  }
}

/// The step and the mesh of a reference that is run.
void read_reference_run(const JsonReader& reader, SweepPlan& plan) {
  const bool is_run =
      plan.reference == ReferenceKind::converged || plan.reference == ReferenceKind::same_mesh;
  if (const auto step = reader.find("reference_step_s")) {
    plan.reference_step = step->number(kPositive);
    if (!is_run) step->fail("no such key, as only converged and same_mesh take it");
    if (plan.reference_step > sweep_sample_times(plan.duration).front())
      step->fail("at most the " + Json(sweep_sample_times(plan.duration).front()).dump() +
                 " s between two samples");
  }
  if (const auto level = reader.find("reference_level")) {
    plan.reference_level = static_cast<int>(level->integer(0, kMaxLevel));
    if (plan.reference != ReferenceKind::converged)
      level->fail("no such key, as only converged takes it");
  }
}

void check_reference_level(const JsonReader& reader, const SweepPlan& plan) {
  for (const SweepSetting& setting : plan.settings)
    if (plan.reference_level && *plan.reference_level < setting.level)
      reader.at("reference_level")
          .fail("at least the finest level compared, " + std::to_string(setting.level));
}

}  // namespace

Scene SweepPlan::scene_of(std::size_t setting) const {
  const Json json = changed_scene(scene, settings[setting].changes, steppers);
  return read(JsonReader(json));
}

SweepPlan read_sweep_plan(const JsonReader& reader, const SceneReader& read,
                          StepperTable steppers) {
  reader.allow_keys({"scene", "grid", "settings", "duration_s", "repeats", "reference",
                     "reference_step_s", "reference_level"});
  SweepPlan plan;
  plan.scene = reader.at("scene").json();
  plan.read = read;
  plan.steppers = steppers;
  read_plan_scene(reader, plan);
  if (const auto repeats = reader.find("repeats"))
    plan.n_repeats = static_cast<int>(repeats->integer(1, kMaxRepeats));
  if (const auto reference = reader.find("reference"))
    plan.reference = reference->word(kReferenceWords);
  read_reference_run(reader, plan);
  std::vector<PlannedChanges> grid(1);
  std::vector<PlannedChanges> settings(1);
  if (const auto at = reader.find("grid")) grid = read_grid(*at);
  if (const auto at = reader.find("settings")) settings = read_settings(*at);
  for (const PlannedChanges& changes : combined(grid, settings))
    plan.settings.push_back(make_setting(plan, changes));
  check_reference_level(reader, plan);
  return plan;
}

Json json_sweep_plan(const SweepPlan& plan) {
  Json settings = Json::array();
  for (const SweepSetting& setting : plan.settings) settings.push_back(setting.changes);
  Json json = {{"scene", plan.scene},
               {"settings", settings},
               {"duration_s", plan.duration},
               {"repeats", plan.n_repeats},
               {"reference", word_for(kReferenceWords, plan.reference)}};
  if (plan.reference_step > 0) json["reference_step_s"] = plan.reference_step;
  if (plan.reference_level) json["reference_level"] = *plan.reference_level;
  return json;
}

std::vector<double> sweep_sample_times(double duration) {
  constexpr int kSamples = 10;
  std::vector<double> times;
  for (int s = 1; s <= kSamples; ++s) times.push_back(duration * s / kSamples);
  return times;
}

}  // namespace pleat
