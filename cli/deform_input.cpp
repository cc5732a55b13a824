#include "cli/deform_input.h"

#include <algorithm>
#include <utility>

#include "cli/scene_input.h"

namespace pleat {
namespace {

/// Numbers, and texts where they are none: the reader of the scene tells them apart.
Json values(const std::vector<std::string>& parts, std::size_t begin, std::size_t end) {
  Json json = Json::array();
  for (std::size_t k = begin; k < end; ++k) json.push_back(option_value(parts[k]));
  return json;
}

/// The values of an option, as many as it takes.
std::vector<std::string> values_of(const std::string& text, std::size_t at_least,
                                   std::size_t at_most, const char* option) {
  std::vector<std::string> parts = split(text);
  if (parts.size() >= at_least && parts.size() <= at_most) return parts;
  const std::string range = at_least == at_most
                                ? std::to_string(at_least)
                                : std::to_string(at_least) + " or " + std::to_string(at_most);
  throw InputError(option,
                   "expected " + range + " numbers separated by commas, got " + quotation(text));
}

Json three_numbers(const std::string& text, const char* option) {
  const std::vector<std::string> parts = values_of(text, 3, 3, option);
  return {{"recovery", option_value(parts[0])},
          {"stretch", option_value(parts[1])},
          {"bending", option_value(parts[2])}};
}

/// "3,4", a group's name, "box:..." or "near:..." as the keys of a scene.
Json place_json(const std::string& text, const char* option) {
  const std::size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  if (colon != std::string::npos && kind == "box") {
    const std::vector<std::string> parts = values_of(text.substr(colon + 1), 6, 6, option);
    Json low = values(parts, 0, 3);
    Json high = values(parts, 3, 6);
    for (std::size_t axis = 0; axis < 3; ++axis)  // any two corners that face each other
      if (low[axis].is_number() && high[axis].is_number() && low[axis] > high[axis])
        std::swap(low[axis], high[axis]);
    return {{"box", {{"low_m", low}, {"high_m", high}}}};
  }
  if (colon != std::string::npos && kind == "near") {
    const std::vector<std::string> parts = values_of(text.substr(colon + 1), 3, 4, option);
    Json near{{"point_m", values(parts, 0, 3)}};
    if (parts.size() == 4) near["radius_m"] = option_value(parts[3]);
    return {{"near", near}};
  }
  if (text.find_first_not_of("+-.0123456789,") != std::string::npos) return {{"group", text}};
  const std::vector<std::string> parts = split(text);
  return {{"vertices", values(parts, 0, parts.size())}};
}

Json as_text(const std::string& text, const char*) { return text; }
Json as_list(const std::string& text, const char*) { return split(text); }

/// An option that sets a key of the scene.
struct KeyOption {
  const char* option;
  const char* key;
  Json (*value)(const std::string& text, const char* option);
  bool is_fabric;
};
constexpr KeyOption kKeyOptions[] = {{"--fabric", "fabric", as_text, true},
                                     {"--measure", "measures", three_numbers, true},
                                     {"--weights", "weights", three_numbers, true},
                                     {"--form", "form", as_text, false},
                                     {"--terms", "terms", as_list, false}};

struct DeformOptions {
  std::vector<std::pair<const KeyOption*, std::string>> keys;
  std::vector<std::string> pins, handles;
  bool has_fabric = false;
};

DeformOptions take_options(Arguments& arguments) {
  DeformOptions options;
  for (const KeyOption& key : kKeyOptions) {
    const auto value = arguments.text(key.option);
    if (!value) continue;
    if (key.is_fabric && std::exchange(options.has_fabric, true))
      throw InputError(key.option, std::string("expected either this or ") +
                                       options.keys[0].first->option + ", got both");
    options.keys.emplace_back(&key, *value);
  }
  options.pins = arguments.texts("--pin");
  options.handles = arguments.texts("--handle");
  return options;
}

/// JSON pointers to what options have set, with the options (Source).
using ChangedPlaces = std::vector<std::pair<std::string, const char*>>;

void add_pin(Json& scene, const std::string& text, ChangedPlaces& changed) {
  Json& pins = scene.emplace("pins", Json::array()).first.value();
  if (!pins.is_array()) return;  // the reader refuses it
  changed.emplace_back("/pins/" + std::to_string(pins.size()), "--pin");
  pins.push_back(place_json(text, "--pin"));
}

/// Moves the scene's handle of the name that stands before the last colon, else adds one there.
void set_handle(Json& scene, const std::string& text, ChangedPlaces& changed) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos)
    throw InputError("--handle", "expected a place and how far it goes, such as hem:0,0.1,0, got " +
                                     quotation(text));
  Json& handles = scene.emplace("handles", Json::array()).first.value();
  if (!handles.is_array()) return;  // the reader refuses it
  const std::string name = text.substr(0, colon);
  const Json move = values(values_of(text.substr(colon + 1), 3, 3, "--handle"), 0, 3);
  auto handle = std::find_if(handles.begin(), handles.end(), [&](const Json& known) {
    return known.is_object() && known.value("name", Json()) == name;
  });
  const std::string pointer = "/handles/" + std::to_string(handle - handles.begin());
  for (const auto& [place, option] : changed)
    if (place == pointer)
      throw InputError("--handle", "expected each handle once, got " + quotation(name) + " twice");
  changed.emplace_back(pointer, "--handle");
  if (handle == handles.end()) {
    handles.push_back(place_json(name, "--handle"));
    handle = handles.end() - 1;
    (*handle)["name"] = name;
  }
  for (const char* key : {"onto_sphere", "turn"}) handle->erase(key);
  (*handle)["move_m"] = move;
}

bool is_obj(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension == ".obj";
}

Json scene_of_mesh(const std::string& file) {
  return {{"name", std::filesystem::path(file).stem().string()},
          {"cloth", {{"mesh", {{"obj", file}}}}}};
}

std::string changed_text(const DeformOptions& options, DeformInput& input) {
  Json scene = is_obj(input.file) ? scene_of_mesh(input.file) : parse_json(read_file(input.file));
  if (scene.is_object()) {  // else the reader refuses it
    for (const auto& [key, value] : options.keys) {
      if (key->is_fabric)
        for (const char* other : {"fabric", "weights", "measures"}) scene.erase(other);
      scene[key->key] = key->value(value, key->option);
      input.options.emplace_back(std::string("/") + key->key, key->option);
    }
    for (const std::string& pin : options.pins) add_pin(scene, pin, input.options);
    for (const std::string& handle : options.handles) set_handle(scene, handle, input.options);
  }
  // An option may hold bytes that are no text.
  return scene.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

DeformSolver held_solver(const DeformScene& scene) {
  const HeldVertices held = held_vertices(scene);
  DeformSolver solver(scene.mesh, scene.form, scene.weights());
  solver.hold(held.vertices);
  solver.restart(held.targets);
  return solver;
}

DeformInput take_deform_scene(Arguments& arguments) {
  DeformInput input;
  input.fabrics = take_fabrics(arguments);
  const DeformOptions options = take_options(arguments);
  input.file = arguments.word("a scene or a mesh (.obj)");
  arguments.finish();
  if (is_obj(input.file) && !options.has_fabric)
    throw InputError("--fabric", "expected this, --measure or --weights beside a mesh, got none");
  input.files_read = {input.file};
  with_source_named(input, [&] {
    input.scene =
        read_deform_scene(changed_text(options, input), input.fabrics,
                          files_beside(is_obj(input.file) ? "" : input.file, input.files_read));
  });
  tell_remark(input.scene.remark);
  return input;
}

}  // namespace pleat
