#include "cli/scene_input.h"

#include "core/scene/whole_file.h"
#include "core/base/check.h"
#include "core/scene/json_text.h"

namespace pleat {
namespace {

/// An option that replaces one value of the scene's text before it is read, so that the same checks
/// hold for both.
struct Override {
  const char* option;
  const char* pointer;
};
constexpr Override kOverrides[] = {
    {"--level", "/refinement/level"},       {"--stepper", "/method/stepper"},
    {"--step", "/method/step_s"},           {"--substeps", "/method/substeps"},
    {"--iterations", "/method/iterations"}, {"--solver", "/method/solver"},
    {"--tolerance", "/method/tolerance"},   {"--fabric", "/fabric/name"},
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

/// "in FILE", or the option when that is what set the value.
[[noreturn]] void name_source(const InputError& error, const std::string& file,
                              const std::vector<Override>& used) {
  for (const Override& entry : used)
    if (error.where() == entry.pointer) throw InputError(entry.option, error.what());
  throw InputError(error.where().empty() ? file : file + ": " + error.where(), error.what());
}

}  // namespace

FabricLibrary take_fabrics(Arguments& arguments) {
  const auto file = arguments.text("--fabrics");
  if (!file) return read_fabrics(embedded_fabrics());
  try {
    return read_fabrics(read_file(*file));
  } catch (const InputError& error) {
    if (error.where() == *file) throw;
    name_source(error, *file, {});
  }
}

SceneInput take_scene(Arguments& arguments) {
  const FabricLibrary fabrics = take_fabrics(arguments);
  std::vector<Override> used;
  std::vector<std::string> values;
  for (const Override& entry : kOverrides) {
    if (const auto value = arguments.text(entry.option)) {
      used.push_back(entry);
      values.push_back(*value);
    }
  }
  const auto n_steps = arguments.whole_number("--steps", 1, 1'000'000'000);
  const std::string file = arguments.word("a scene file");
  const std::string text = read_file(file);
  try {
    Json json = parse_json(text);
    for (std::size_t i = 0; i < used.size(); ++i)
      replace(json, used[i].pointer, option_value(values[i]));
    // An option may hold bytes that are no text.
    Scene scene = read_scene(json.dump(-1, ' ', false, Json::error_handler_t::replace), fabrics);
    if (n_steps) scene.duration = *n_steps * scene.method.step;
    return {std::move(scene), file};
  } catch (const InputError& error) {
    name_source(error, file, used);
  }
}

}  // namespace pleat
