#include "cli/scene_input.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "core/scene/cloth_section.h"
#include "core/scene/json_reader.h"

namespace pleat {
namespace {

/// An option that replaces one value of the scene's text before it is read, so that the same checks
/// hold for both.
struct Override {
  const char* option;
  const char* pointer;
};
constexpr Override kOverrides[] = {
    {"--fabric", "/fabric/name"},       {"--level", "/refinement/level"},
    {"--stepper", "/method/stepper"},   {"--step", "/method/step_s"},
    {"--substeps", "/method/substeps"}, {"--iterations", "/method/iterations"},
    {"--solver", "/method/solver"},     {"--tolerance", "/method/tolerance"},
    {"--duration", "/duration_s"},
};

/// A number where the text is one, else the text itself.
Json option_value(const std::string& text) {
  const Json value = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  return value.is_number() ? value : Json(text);
}

/// Sets the value at a pointer; what stands in the way and is no object is left for the reader to
/// refuse.
void replace(Json& scene, const std::string& pointer, Json value) {
  const std::size_t slash = pointer.find('/', 1);
  const std::string key = pointer.substr(1, slash == std::string::npos ? slash : slash - 1);
  if (!scene.is_object()) return;
  if (slash == std::string::npos) {
    scene[key] = std::move(value);
    return;
  }
  if (!scene.contains(key)) scene[key] = Json::object();
  replace(scene[key], pointer.substr(slash), std::move(value));
}

/// Names of files in a scene are relative to its own folder.
FileSource files_beside(const std::string& scene_file) {
  return [folder = std::filesystem::path(scene_file).parent_path()](const std::string& name) {
    return read_file(folder / name);
  };
}

/// Makes room for another fabric's name; rigidity stays that at rest or in motion.
void clear_fabric(Json& scene) {
  if (!scene.is_object() || !scene.contains("fabric")) return;
  const Json old = std::move(scene["fabric"]);
  scene["fabric"] = Json::object();
  if (old.is_object() && old.contains("name") && old.contains("bending"))
    scene["fabric"]["bending"] = old["bending"];
}

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

/// Takes out of the method what another stepper cannot take.
void clear_method(Json& scene, const std::string& stepper) {
  if (!scene.is_object()) return;
  Json& method = scene.emplace("method", Json::object()).first.value();
  if (!method.is_object() ||
      method.value("stepper", Json(name(MethodOptions{}.stepper))) == stepper)
    return;
  if (stepper == "explicit") {
    method["substeps"] = "stable";
  } else if (method.contains("substeps") && method["substeps"].is_string()) {
    method.erase("substeps");
  }
  if (stepper == "projective" && method.value("solver", Json()) == "cg") method.erase("solver");
}

}  // namespace

bool SceneInput::is_set_by(std::string_view option) const {
  return std::find(options.begin(), options.end(), option) != options.end();
}

void SceneInput::throw_with_source(const InputError& error) const {
  const std::string& where = error.where();
  for (const Override& entry : kOverrides) {
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
  const std::int64_t n = n_refined_vertices(scene, scene.level);
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

SceneInput take_scene(Arguments& arguments) {
  const FabricLibrary fabrics = take_fabrics(arguments);
  SceneInput input;
  std::vector<std::pair<Override, std::string>> overrides;
  for (const Override& entry : kOverrides) {
    if (const auto value = arguments.text(entry.option)) {
      overrides.emplace_back(entry, *value);
      input.options.emplace_back(entry.option);
    }
  }
  const auto n_steps = arguments.whole_number("--steps", 1, kMaxSteps);
  if (n_steps && input.is_set_by("--duration"))
    throw InputError("--steps", "expected either this or --duration, got both");
  if (n_steps) input.options.emplace_back("--steps");
  input.file = arguments.word("a scene file");
  try {
    Json json = parse_json(read_file(input.file));
    for (const auto& [entry, value] : overrides) {
      const std::string_view option = entry.option;
      if (option == "--fabric") clear_fabric(json);
      if (option == "--stepper") clear_method(json, value);
      replace(json, entry.pointer, option_value(value));
    }
    if (n_steps) replace(json, "/duration_s", duration_of(*n_steps, json));
    if (json.is_object() && json.contains("duration_s"))
      input.has_duration = is_duration(json["duration_s"]);
    // An option may hold bytes that are no text.
    input.scene = read_scene(json.dump(-1, ' ', false, Json::error_handler_t::replace), fabrics,
                             files_beside(input.file));
  } catch (const FileError&) {
    throw;
  } catch (const InputError& error) {
    input.throw_with_source(error);
  } catch (const std::bad_alloc&) {
    throw InputError(input.file, "not enough memory to read it");
  }
  return input;
}

}  // namespace pleat
