#include "core/scene/format/scene_override.h"

#include <algorithm>
#include <charconv>
#include <vector>

#include "core/base/check.h"
#include "core/dynamics/method_settings.h"

namespace pleat {
namespace {

constexpr std::size_t kMaxTokens = 32;  // depth to which JSON text may nest
constexpr const char* kStepperPointer = "/method/stepper";
constexpr const char* kSolverPointer = "/method/solver";
constexpr const char* kFabricPointer = "/fabric/name";

[[noreturn]] void refuse(const std::string& pointer, const std::string& expected) {
  throw InputError(cut(pointer), "expected " + expected + ", got " + abbreviated(Json(pointer)));
}

/// "~1" stands for "/" and "~0" for "~".
std::string unescaped(std::string_view token, const std::string& pointer) {
  std::string key;
  for (std::size_t i = 0; i < token.size(); ++i) {
    if (token[i] != '~') {
      key += token[i];
      continue;
    }
    const char next = ++i < token.size() ? token[i] : '\0';
    if (next != '0' && next != '1') refuse(pointer, "a JSON pointer with ~ only in ~0 and ~1");
    key += next == '0' ? '~' : '/';
  }
  return key;
}

std::vector<std::string> tokens_of(const std::string& pointer) {
  if (pointer.empty() || pointer.front() != '/')
    refuse(pointer, "a JSON pointer into the scene, such as \"/method/substeps\"");
  std::vector<std::string> tokens;
  for (std::size_t begin = 1; begin <= pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', begin), pointer.size());
    tokens.push_back(unescaped(std::string_view(pointer).substr(begin, end - begin), pointer));
    if (tokens.size() > kMaxTokens) refuse(pointer, "a JSON pointer of at most 32 levels");
    begin = end + 1;
  }
  return tokens;
}

Json& element_at(Json& array, const std::string& token, const std::string& pointer) {
  std::size_t index = 0;
  const char* end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, index);
  if (error != std::errc() || stop != end || index >= array.size())
    refuse(pointer, "a place that the scene has");
  return array[index];
}

void set_value(Json& scene, const SceneOverride& change) {
  Json* place = &scene;
  for (const std::string& token : tokens_of(change.pointer)) {
    if (place->is_array()) {
      place = &element_at(*place, token, change.pointer);
    } else if (place->is_object()) {
      place = &place->emplace(token, Json::object()).first.value();
    } else {
      return;
    }
  }
  *place = change.value;
}

void clear_fabric(Json& scene) {
  if (!scene.contains("fabric")) return;
  const Json old = std::move(scene["fabric"]);
  scene["fabric"] = Json::object();
  if (old.is_object() && old.contains("name") && old.contains("bending"))
    scene["fabric"]["bending"] = old["bending"];
}

/// Leaves out what was chosen for another stepper, so that the new one starts from its own.
void clear_method(Json& scene, const Json& stepper, StepperTable steppers) {
  Json& method = scene.emplace("method", Json::object()).first.value();
  if (!method.is_object() ||
      method.value("stepper", Json(MethodOptions{}.stepper->name)) == stepper)
    return;
  for (const MethodSetting* setting : all_settings(steppers)) method.erase(setting->key);
}

/// Leaves out what is of effect beside other solvers alone.
void clear_idle(Json& scene, const Json& solver, StepperTable steppers) {
  const auto method = scene.find("method");
  if (method == scene.end() || !method->is_object()) return;
  for (const MethodSetting* setting : all_settings(steppers)) {
    const auto is_other = [&](const Beside& known) {
      return std::string_view(known.key) == "solver" ? Json(known.word) != solver
                                                     : !method->contains(known.key);
    };
    const auto& beside = setting->beside;
    if (!beside.empty() && std::all_of(beside.begin(), beside.end(), is_other))
      method->erase(setting->key);
  }
}

/// Overrides of lower rank are set first.
std::size_t rank(const SceneOverride& change) {
  const bool clears = change.pointer == kStepperPointer || change.pointer == kSolverPointer ||
                      change.pointer == kFabricPointer;
  return 2 * tokens_of(change.pointer).size() - (clears ? 1 : 0);
}

}  // namespace

void override_scene(Json& scene, std::span<const SceneOverride> overrides, StepperTable steppers) {
  std::vector<const SceneOverride*> order;
  for (const SceneOverride& change : overrides) order.push_back(&change);
  std::stable_sort(order.begin(), order.end(), [](const SceneOverride* a, const SceneOverride* b) {
    return rank(*a) < rank(*b);
  });
  if (!scene.is_object()) return;
  for (const SceneOverride* change : order) {
    if (change->pointer == kFabricPointer) clear_fabric(scene);
    if (change->pointer == kStepperPointer) clear_method(scene, change->value, steppers);
    if (change->pointer == kSolverPointer) clear_idle(scene, change->value, steppers);
    set_value(scene, *change);
  }
}

}  // namespace pleat
