#include "cli/scene_input.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace pleat {
namespace {

/// Options that replace one value of the scene's text before it is read, so that the same checks
/// hold for both, and their JSON pointers.
constexpr std::pair<const char*, const char*> kSceneOptions[] = {
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

std::string SceneInput::need() const {
  if (!is_read) return Source::need();
  return "for " + std::to_string(scene.cloth->n_vertices(scene.level)) + " vertices";
}

FabricLibrary take_fabrics(Arguments& arguments) {
  const auto file = arguments.text("--fabrics");
  if (!file) return read_fabrics(embedded_fabrics());
  return with_source_named(Source{*file}, [&] { return read_fabrics(read_file(*file)); });
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
  for (const auto& [option, pointer] : kSceneOptions) {
    const auto value = arguments.text(option);
    if (!value) continue;
    changes.overrides.push_back({pointer, option_value(*value)});
    changes.options.emplace_back(pointer, option);
  }
  changes.n_steps = arguments.whole_number("--steps", 1, kMaxSteps);
  if (!changes.n_steps) return changes;
  if (Source{"", changes.options}.is_set_by("--duration"))
    throw InputError("--steps", "expected either this or --duration, got both");
  changes.options.emplace_back("/duration_s", "--steps");
  return changes;
}

SceneInput read_scene_input(const std::string& file, const SceneChanges& changes,
                            const FabricLibrary& fabrics) {
  SceneInput input;
  input.file = file;
  input.files_read = {file};
  input.options = changes.options;
  with_source_named(input, [&] {
    Json& json = input.json;
    json = parse_json(read_file(file));
    override_scene(json, changes.overrides);
    if (changes.n_steps)
      override_scene(json,
                     std::array{SceneOverride{"/duration_s", duration_of(*changes.n_steps, json)}});
    // A step may be too short for a duration that is one.
    const Json duration = json.is_object() ? json.value("duration_s", Json(1)) : Json(1);
    if (input.is_set_by("--step") && is_duration(duration))
      input.options.emplace_back("/duration_s", "--step");
    input.scene = read_scene(JsonReader(json), fabrics, files_beside(file, input.files_read));
    tell_remark(input.scene.cloth->remark());
    input.is_read = true;
  });
  return input;
}

std::vector<SceneInput> take_scenes(Arguments& arguments, const std::vector<std::string>& others) {
  const FabricLibrary fabrics = take_fabrics(arguments);
  const SceneChanges changes = take_scene_changes(arguments);
  std::vector<std::string> files{arguments.word("a scene file")};
  arguments.finish();
  files.insert(files.end(), others.begin(), others.end());
  std::vector<SceneInput> inputs;
  for (const std::string& file : files) inputs.push_back(read_scene_input(file, changes, fabrics));
  return inputs;
}

SceneInput take_scene(Arguments& arguments) {
  return std::move(take_scenes(arguments, {}).front());
}

}  // namespace pleat
