#include "cli/sweep_input.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "core/scene/format/method_section.h"
#include "core/sweep/usual_settings.h"

namespace pleat {
namespace {

/// The steppers named, the usual ones where none is.
std::vector<const StepperType*> chosen_steppers(const std::vector<std::string>& names,
                                                const Scene& scene) {
  if (names.empty()) return usual_steppers(standard_steppers(), scene);
  std::vector<const StepperType*> chosen;
  for (const std::string& wanted : names) {
    const StepperType* type = find_stepper(standard_steppers(), wanted);
    if (type == nullptr)
      throw InputError("--steppers", "expected some of " + stepper_names(standard_steppers()) +
                                         ", got " + quotation(wanted));
    if (std::find(chosen.begin(), chosen.end(), type) != chosen.end())
      throw InputError("--steppers", "expected each stepper once, got " + wanted + " twice");
    chosen.push_back(type);
  }
  return chosen;
}

Json stepper_settings(const std::vector<std::string>& names, const Scene& scene) {
  Json settings = Json::array();
  for (const StepperType* type : chosen_steppers(names, scene))
    for (const MethodOptions& method : usual_settings(*type, scene.method))
      settings.push_back({{"/method", json_method(method)}});
  return settings;
}

/// Values between commas: as JSON where all of them are, else numbers and texts.
Json value_list(const std::string& text) {
  try {
    return parse_json("[" + text + "]");
  } catch (const InputError&) {
  }
  Json values = Json::array();
  for (const std::string& value : split(text)) values.push_back(option_value(value));
  return values;
}

/// The plan that options make, but for its scene and steppers.
struct SweepOptions {
  Json plan = {{"grid", Json::object()}};
  std::vector<std::string> steppers;
  Source given = {};  // names the options

  void set(const char* key, const char* option, Json value) {
    plan[key] = std::move(value);
    given.options.emplace_back(std::string("/") + key, option);
  }
  void add_list(const char* option, const std::string& pointer, const std::string& list) {
    const auto key = text_value(pointer).get<std::string>();
    if (!plan["grid"].emplace(key, value_list(list)).second)
      throw InputError(option, "expected each pointer once, got " + quotation(key) + " twice");
    given.options.emplace_back("/grid/" + pointer_token(key), option);
  }
};

SweepOptions take_sweep_options(Arguments& arguments) {
  SweepOptions options;
  if (const auto levels = arguments.text("--levels"))
    options.add_list("--levels", "/refinement/level", *levels);
  for (const std::string& set : arguments.texts("--set")) {
    const std::size_t equals = set.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError(
          "--set",
          "expected a pointer and its values, such as /method/substeps=1,2, got " + quotation(set));
    options.add_list("--set", set.substr(0, equals), set.substr(equals + 1));
  }
  options.steppers = arguments.list("--steppers");
  if (!options.steppers.empty()) options.given.options.emplace_back("/settings", "--steppers");
  if (const auto n = arguments.whole_number("--repeat", 1, 1000))
    options.set("repeats", "--repeat", *n);
  if (const auto kind = arguments.text("--reference"))
    options.set("reference", "--reference", text_value(*kind));
  if (const auto level = arguments.whole_number("--reference-level", 0, kMaxLevel))
    options.set("reference_level", "--reference-level", *level);
  arguments.refuse({"--level"}, "a sweep does not take this option, but --levels");
  arguments.refuse({"--stepper", "--substeps", "--iterations"},
                   "a sweep does not take this option, but --steppers and --set");
  return options;
}

/// The plan of a file, or nothing. Broken files are no plans: who reads them as a scene says what
/// is wrong.
std::optional<Json> plan_in_file(const std::string& file) {
  const std::string text = read_file(file);
  try {
    Json json = parse_json(text);
    if (json.is_object() && json.contains("scene")) return json;
  } catch (const InputError&) {
  }
  return std::nullopt;
}

/// A file's plan with the scene that it may name in its place.
Json whole_plan(Json json, SweepInput& input) {
  if (!json["scene"].is_string()) return json;
  const std::filesystem::path folder = std::filesystem::path(input.file).parent_path();
  input.scene_file = (folder / json["scene"].get<std::string>()).string();
  json["scene"] = with_source_named(Source{input.scene_file},
                                    [&] { return parse_json(read_file(input.scene_file)); });
  return json;
}

Json plan_of_options(const SweepOptions& options, const SceneInput& scene) {
  Json plan = options.plan;
  plan["scene"] = scene.json;
  if (!options.steppers.empty() || !options.given.is_set_by("--set"))
    plan["settings"] = stepper_settings(options.steppers, scene.scene);
  return plan;
}

}  // namespace

std::vector<std::filesystem::path> SweepInput::files_read() const {
  if (scene) return scene->files_read;
  return {file, scene_file};
}

void SweepInput::throw_named(const InputError& error) const {
  const std::string& where = error.where();
  if (scene && (where == "/grid" || where == "/settings"))
    throw InputError("--set", error.sentence());
  const bool in_scene = where == "/scene" || where.rfind("/scene/", 0) == 0;
  if (!in_scene || (!scene && scene_file.empty())) Source::throw_named(error);
  Source{scene ? file : scene_file, options}.throw_named({where.substr(6), error.sentence()});
}

std::string SweepInput::need() const {
  double most = 0;
  for (const SweepSetting& setting : plan.settings) most = std::max(most, setting.n_vertices);
  return "for " + std::to_string(std::llround(most)) + " vertices";
}

SweepInput take_sweep(Arguments& arguments) {
  const SweepOptions options = take_sweep_options(arguments);
  const FabricLibrary fabrics = take_fabrics(arguments);
  const SceneChanges changes = take_scene_changes(arguments);
  SweepInput input;
  input.file = arguments.word("a scene's or a plan's file");
  arguments.finish();
  const std::optional<Json> plan_file = plan_in_file(input.file);
  for (const auto* given : {&options.given.options, &changes.options})
    if (plan_file && !given->empty())
      throw InputError(given->front().second, "a plan's file says this itself");
  if (!plan_file) {
    input.scene = read_scene_input(input.file, changes, fabrics);
    input.options = options.given.options;
    input.options.insert(input.options.end(), input.scene->options.begin(),
                         input.scene->options.end());
  }
  with_source_named(input, [&] {
    const Json plan =
        plan_file ? whole_plan(*plan_file, input) : plan_of_options(options, *input.scene);
    input.plan = read_sweep_plan(JsonReader(plan), [fabrics](const JsonReader& scene) {
      return read_scene(scene, fabrics);
    });
  });
  return input;
}

}  // namespace pleat
