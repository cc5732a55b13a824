#include "cli/scene_input.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "core/files/json_reader.h"
#include "core/scene/format/cloth_section.h"

namespace pleat {
namespace {

/// An option that replaces one value of the scene's text before it is read, so that the same checks
/// hold for both.
struct SceneOption {
  const char* option;
  const char* pointer;
};
constexpr SceneOption kSceneOptions[] = {
    {"--fabric", "/fabric/name"},       {"--level", "/refinement/level"},
    {"--stepper", "/method/stepper"},   {"--step", "/method/step_s"},
    {"--substeps", "/method/substeps"}, {"--iterations", "/method/iterations"},
    {"--solver", "/method/solver"},     {"--tolerance", "/method/tolerance"},
    {"--duration", "/duration_s"},
};

/// The duration of so many steps of the scene [s], not rounded to more: the most steps are allowed.
double duration_of(int n_steps, const Json& scene) {
  const Json::json_pointer pointer("/method/step_s");
  const Json given = scene.is_object() && scene.contains(pointer) ? scene[pointer] : Json();
  const double step = given.is_number() ? given.get<double>() : MethodOptions{}.step;
  const double duration = n_steps * step;
  return duration / step > n_steps ? std::nextafter(duration, 0) : duration;
}

bool is_duration(const Json& value) {
  return value.is_number() && value.get<double>() > 0 && value.get<double>() <= kLargestNumber;
}

}  // namespace

bool SceneInput::is_set_by(std::string_view option) const {
  return std::find(options.begin(), options.end(), option) != options.end();
}

void SceneInput::throw_with_source(const InputError& error) const {
  const std::string& where = error.where();
  for (const SceneOption& entry : kSceneOptions) {
    // The numbers of a fabric come with its name.
    const bool sets_it = where == entry.pointer || where + "/name" == entry.pointer;
    if (sets_it && is_set_by(entry.option)) throw InputError(entry.option, error.what());
  }
  if (where == "/duration_s" && is_set_by("--steps")) throw InputError("--steps", error.what());
  if (where == "/duration_s" && is_set_by("--step") && has_duration)  // which is too many steps
    throw InputError("--step", error.what());
  throw InputError(where.empty() ? file : file + ": " + where, error.what());
}

void SceneInput::throw_out_of_memory() const {
  const std::int64_t n = scene.cloth->n_vertices(scene.level);
  throw InputError(file, "not enough memory for " + std::to_string(n) + " vertices");
}

FabricLibrary take_fabrics(Arguments& arguments) {
  const auto file = arguments.text("--fabrics");
  if (!file) return read_fabrics(embedded_fabrics());
  const std::string text = read_file(*file);
  try {
    return read_fabrics(text);
  } catch (const InputError& error) {
    throw InputError(error.where().empty() ? *file : *file + ": " + error.where(), error.what());
  }
}

FileSource files_beside(const std::string& scene_file, std::vector<std::filesystem::path>& read) {
  return
      [folder = std::filesystem::path(scene_file).parent_path(), &read](const std::string& name) {
        read.push_back(folder / name);
        return read_file(read.back());
      };
}

Json text_value(const std::string& text) {
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace));
}

Json option_value(const std::string& text) {
  const Json value = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  return value.is_number() ? value : text_value(text);
}

void tell_remark(const std::string& remark) {
  if (!remark.empty()) std::fprintf(stderr, "%s\n", printable(remark).c_str());
}

SceneChanges take_scene_changes(Arguments& arguments) {
  SceneChanges changes;
  for (const SceneOption& entry : kSceneOptions) {
    const auto value = arguments.text(entry.option);
    if (!value) continue;
    changes.overrides.push_back({entry.pointer, option_value(*value)});
    changes.options.emplace_back(entry.option);
  }
  changes.n_steps = arguments.whole_number("--steps", 1, kMaxSteps);
  if (!changes.n_steps) return changes;
  const auto& given = changes.options;
  if (std::find(given.begin(), given.end(), "--duration") != given.end())
    throw InputError("--steps", "expected either this or --duration, got both");
  changes.options.emplace_back("--steps");
  return changes;
}

SceneInput read_scene_input(const std::string& file, const SceneChanges& changes,
                            const FabricLibrary& fabrics) {
  SceneInput input;
  input.file = file;
  input.files_read = {file};
  input.options = changes.options;
  try {
    Json& json = input.json;
    json = parse_json(read_file(file));
    override_scene(json, changes.overrides);
    if (changes.n_steps)
      override_scene(json,
                     std::array{SceneOverride{"/duration_s", duration_of(*changes.n_steps, json)}});
    if (json.is_object() && json.contains("duration_s"))
      input.has_duration = is_duration(json["duration_s"]);
    input.scene = read_scene(JsonReader(json), fabrics, files_beside(file, input.files_read));
    tell_remark(input.scene.cloth->remark());
  } catch (const FileError&) {
    throw;
  } catch (const InputError& error) {
    input.throw_with_source(error);
  } catch (const std::bad_alloc&) {
    throw InputError(file, "not enough memory to read it");
  }
  return input;
}

SceneInput take_scene(Arguments& arguments) {
  const FabricLibrary fabrics = take_fabrics(arguments);
  const SceneChanges changes = take_scene_changes(arguments);
  return read_scene_input(arguments.word("a scene file"), changes, fabrics);
}

}  // namespace pleat
