#include "cli/deform_input.h"

#include <algorithm>
#include <filesystem>

#include "cli/scene_input.h"

namespace pleat {
namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// Numbers, and texts where they are none: the reader of the scene tells them apart.
Json values(const std::vector<std::string>& parts, std::size_t begin, std::size_t end) {
  Json json = Json::array();
  for (std::size_t k = begin; k < end; ++k) json.push_back(option_value(parts[k]));
  return json;
}

/// As many values as the option takes.
std::vector<std::string> split(const std::string& text, std::size_t at_least, std::size_t at_most,
                               const char* option) {
  std::vector<std::string> parts = split(text);
  if (parts.size() >= at_least && parts.size() <= at_most) return parts;
  const std::string range = at_least == at_most
                                ? std::to_string(at_least)
                                : std::to_string(at_least) + " or " + std::to_string(at_most);
  throw InputError(
      option, "expected " + range + " numbers separated by commas, got " + abbreviated(Json(text)));
}

Json three_numbers(const std::string& text, const char* option) {
  const std::vector<std::string> parts = split(text, 3, 3, option);
  return {{"recovery", option_value(parts[0])},
          {"stretch", option_value(parts[1])},
          {"bending", option_value(parts[2])}};
}

/// "3,4", a group's name, "box:..." or "near:..." as the keys of a scene.
Json place_json(const std::string& text, const char* option) {
  const std::size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  if (colon != std::string::npos && kind == "box") {
    const std::vector<std::string> parts = split(text.substr(colon + 1), 6, 6, option);
    Json low = values(parts, 0, 3);
    Json high = values(parts, 3, 6);
    for (std::size_t axis = 0; axis < 3; ++axis)  // any two corners that face each other
      if (low[axis].is_number() && high[axis].is_number() && low[axis] > high[axis])
        std::swap(low[axis], high[axis]);
    return {{"box", {{"low_m", low}, {"high_m", high}}}};
  }
  if (colon != std::string::npos && kind == "near") {
    const std::vector<std::string> parts = split(text.substr(colon + 1), 3, 4, option);
    Json near{{"point_m", values(parts, 0, 3)}};
    if (parts.size() == 4) near["radius_m"] = option_value(parts[3]);
    return {{"near", near}};
  }
  if (text.find_first_not_of("+-.0123456789,") != std::string::npos) return {{"group", text}};
  const std::vector<std::string> parts = split(text);
  return {{"vertices", values(parts, 0, parts.size())}};
}

/// A scene's text with the options' changes.
class DeformText {
 public:
  DeformText(Json json, DeformInput& input) : json_(std::move(json)), input_(input) {}

  void set(const char* key, Json value, const char* option) {
    if (json_.is_object()) json_[key] = std::move(value);
    input_.sources.emplace_back(std::string("/") + key, option);
  }

  /// A fabric in one of its three ways, in place of the scene's.
  void set_fabric(const char* key, Json value, const char* option) {
    if (json_.is_object())
      for (const char* other : {"fabric", "weights", "measures"}) json_.erase(other);
    set(key, std::move(value), option);
  }

  void add_pin(const std::string& text) { add("pins", place_json(text, "--pin"), "--pin"); }

  void add_handle(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos)
      throw InputError("--handle",
                       "expected a place and how far it goes, such as hem:0,0.1,0, got " +
                           abbreviated(Json(text)));
    const std::string place = text.substr(0, colon);
    const std::vector<std::string> parts = split(text.substr(colon + 1), 3, 3, "--handle");
    const Json move = values(parts, 0, 3);
    if (Json* named = handle(place)) {
      for (const char* key : {"onto_sphere", "turn"}) named->erase(key);
      (*named)["move_m"] = move;
      return;
    }
    Json added = place_json(place, "--handle");
    added["name"] = place;
    added["move_m"] = move;
    add("handles", std::move(added), "--handle");
  }

  /// An option may hold bytes that are no text.
  std::string text() const { return json_.dump(-1, ' ', false, Json::error_handler_t::replace); }

 private:
  void add(const char* key, Json value, const char* option) {
    if (!json_.is_object()) return;  // for the reader to refuse
    Json& array = json_.emplace(key, Json::array()).first.value();
    if (!array.is_array()) return;
    std::string pointer = "/";
    pointer.append(key).append("/").append(std::to_string(array.size()));
    input_.sources.emplace_back(std::move(pointer), option);
    array.push_back(std::move(value));
  }

  /// The scene's handle of that name, marked as set by the option; null when there is none.
  Json* handle(const std::string& name) {
    if (!json_.is_object() || !json_.contains("handles") || !json_["handles"].is_array())
      return nullptr;
    Json& handles = json_["handles"];
    for (std::size_t k = 0; k < handles.size(); ++k) {
      if (!handles[k].is_object() || handles[k].value("name", Json()) != name) continue;
      const std::string pointer = "/handles/" + std::to_string(k);
      for (const auto& source : input_.sources)
        if (source.first == pointer)
          throw InputError("--handle",
                           "expected each handle once, got " + abbreviated(Json(name)) + " twice");
      input_.sources.emplace_back(pointer, "--handle");
      return &handles[k];
    }
    return nullptr;
  }

  Json json_;
  DeformInput& input_;
};

struct DeformOptions {
  std::vector<std::pair<const char*, std::string>> fabric;  // option and value
  std::optional<std::string> form;
  std::vector<std::string> terms, pins, handles;
};

std::vector<std::string> take_all(Arguments& arguments, const char* option) {
  std::vector<std::string> all;
  while (const auto value = arguments.text(option)) all.push_back(*value);
  return all;
}

DeformOptions take_options(Arguments& arguments) {
  DeformOptions options;
  for (const char* option : {"--fabric", "--measure", "--weights"})
    if (const auto value = arguments.text(option)) options.fabric.emplace_back(option, *value);
  if (options.fabric.size() > 1)
    throw InputError(options.fabric[1].first, std::string("expected either this or ") +
                                                  options.fabric[0].first + ", got both");
  options.form = arguments.text("--form");
  options.terms = arguments.list("--terms");
  options.pins = take_all(arguments, "--pin");
  options.handles = take_all(arguments, "--handle");
  return options;
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
  DeformText text(
      is_obj(input.file) ? scene_of_mesh(input.file) : parse_json(read_file(input.file)), input);
  for (const auto& [option, value] : options.fabric) {
    if (option == std::string("--fabric")) text.set_fabric("fabric", value, option);
    if (option == std::string("--measure"))
      text.set_fabric("measures", three_numbers(value, option), option);
    if (option == std::string("--weights"))
      text.set_fabric("weights", three_numbers(value, option), option);
  }
  if (options.form) text.set("form", *options.form, "--form");
  if (!options.terms.empty()) text.set("terms", options.terms, "--terms");
  for (const std::string& pin : options.pins) text.add_pin(pin);
  for (const std::string& handle : options.handles) text.add_handle(handle);
  return text.text();
}

}  // namespace

void DeformInput::throw_with_source(const InputError& error) const {
  const std::string& where = error.where();
  for (const auto& [pointer, option] : sources)
    if (where == pointer || where.rfind(pointer + "/", 0) == 0)
      throw InputError(option, error.what());
  if (where.empty()) throw InputError(file, error.what());
  const bool is_named = where.rfind(file, 0) == 0;  // by the reader of a mesh
  throw InputError(is_named ? where : file + ": " + where, error.what());
}

void DeformInput::throw_out_of_memory() const {
  throw InputError(file, "not enough memory for its cloth");
}

DeformInput take_deform_scene(Arguments& arguments) {
  DeformInput input;
  input.fabrics = take_fabrics(arguments);
  const DeformOptions options = take_options(arguments);
  input.file = arguments.word("a scene or a mesh (.obj)");
  if (is_obj(input.file) && options.fabric.empty())
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
