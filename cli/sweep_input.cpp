#include "cli/sweep_input.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "core/base/check.h"
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
                                         ", got " + abbreviated(Json(wanted)));
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
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    values.push_back(option_value(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return values;
}

/// The options that say something about a plan.
struct SweepOptions {
  Json values = Json::object();  // of the grid
  std::map<std::string, const char*> grid;
  std::vector<std::string> steppers;
  std::optional<int> n_repeats;
  std::optional<std::string> reference;
  std::optional<int> reference_level;
  std::vector<std::string_view> given;

  void add_list(const char* option, const std::string& pointer, const std::string& list) {
    const auto key = text_value(pointer).get<std::string>();
    if (!grid.emplace(key, option).second)
      throw InputError(option,
                       "expected each pointer once, got " + abbreviated(Json(key)) + " twice");
    values[key] = value_list(list);
    given.emplace_back(option);
  }
  bool is_given(std::string_view option) const {
    return std::find(given.begin(), given.end(), option) != given.end();
  }
};

SweepOptions take_plan_options(Arguments& arguments) {
  SweepOptions options;
  if (const auto levels = arguments.text("--levels"))
    options.add_list("--levels", "/refinement/level", *levels);
  while (const auto set = arguments.text("--set")) {
    const std::size_t equals = set->find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError("--set",
                       "expected a pointer and its values, such as /method/substeps=1,2, got " +
                           abbreviated(Json(*set)));
    options.add_list("--set", set->substr(0, equals), set->substr(equals + 1));
  }
  options.steppers = arguments.list("--steppers");
  if (!options.steppers.empty()) options.given.emplace_back("--steppers");
  options.n_repeats = arguments.whole_number("--repeat", 1, 1000);
  if (options.n_repeats) options.given.emplace_back("--repeat");
  options.reference = arguments.text("--reference");
  if (options.reference) options.given.emplace_back("--reference");
  options.reference_level = arguments.whole_number("--reference-level", 0, kMaxLevel);
  if (options.reference_level) options.given.emplace_back("--reference-level");
  arguments.refuse("--level", "a sweep does not take this option, but --levels");
  for (const char* option : {"--stepper", "--substeps", "--iterations"})
    arguments.refuse(option, "a sweep does not take this option, but --steppers and --set");
  return options;
}

/// The plan of a file, or nothing. Broken files are no plans: who reads them as a scene says what
/// is wrong.
std::optional<Json> plan_in_file(const std::string& file) {
  try {
    Json json = parse_json(read_file(file));
    if (json.is_object() && json.contains("scene")) return json;
  } catch (const FileError&) {
    throw;
  } catch (const InputError&) {
  }
  return std::nullopt;
}

/// A file's plan with the scene that it may name in its place.
Json whole_plan(Json json, SweepInput& input) {
  if (!json["scene"].is_string()) return json;
  const std::filesystem::path folder = std::filesystem::path(input.file).parent_path();
  input.scene_file = (folder / json["scene"].get<std::string>()).string();
  try {
    json["scene"] = parse_json(read_file(input.scene_file));
  } catch (const FileError&) {
    throw;
  } catch (const InputError& error) {
    throw InputError(input.scene_file + ": " + error.where(), error.what());
  }
  return json;
}

Json plan_of_options(const SweepOptions& options, const SceneInput& scene) {
  Json plan = {{"scene", scene.json}, {"grid", options.values}};
  if (!options.steppers.empty() || !options.is_given("--set"))
    plan["settings"] = stepper_settings(options.steppers, scene.scene);
  if (options.n_repeats) plan["repeats"] = *options.n_repeats;
  if (options.reference) plan["reference"] = text_value(*options.reference);
  if (options.reference_level) plan["reference_level"] = *options.reference_level;
  return plan;
}

}  // namespace

std::vector<std::filesystem::path> SweepInput::files_read() const {
  if (scene) return scene->files_read;
  return {file, scene_file};
}

void SweepInput::throw_with_source(const InputError& error) const {
  const std::string& where = error.where();
  const bool in_scene = where == "/scene" || where.rfind("/scene/", 0) == 0;
  const std::string in_its_file = in_scene ? where.substr(std::string("/scene").size()) : where;
  if (scene) {
    for (const auto& [pointer, option] : grid)
      if (where.rfind("/grid/" + pointer_token(pointer), 0) == 0)
        throw InputError(option, error.what());
    if (where == "/grid" || where == "/settings") throw InputError("--set", error.what());
    if (where == "/reference") throw InputError("--reference", error.what());
    if (where == "/reference_level") throw InputError("--reference-level", error.what());
    if (where.rfind("--", 0) == 0) throw error;  // an option of its own
    scene->throw_with_source(InputError(in_its_file, error.what()));
  }
  const bool in_scene_file = in_scene && !scene_file.empty();
  const std::string& place = in_scene_file ? scene_file : file;
  const std::string& pointer = in_scene_file ? in_its_file : where;
  throw InputError(pointer.empty() ? place : place + ": " + pointer, error.what());
}

void SweepInput::throw_out_of_memory() const {
  double most = 0;
  for (const SweepSetting& setting : plan.settings) most = std::max(most, setting.n_vertices);
  throw InputError(file,
                   "not enough memory for " + std::to_string(std::llround(most)) + " vertices");
}

SweepInput take_sweep(Arguments& arguments) {
  const SweepOptions options = take_plan_options(arguments);
  const FabricLibrary fabrics = take_fabrics(arguments);
  const SceneChanges changes = take_scene_changes(arguments);
  SweepInput input;
  input.file = arguments.word("a scene's or a plan's file");
  input.grid = options.grid;
  const std::optional<Json> plan_file = plan_in_file(input.file);
  for (const auto* given : {&options.given, &changes.options})
    if (plan_file && !given->empty())
      throw InputError(std::string(given->front()), "a plan's file says this itself");
  if (!plan_file) input.scene = read_scene_input(input.file, changes, fabrics);
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
