#include "core/scene/scene_file.h"

#include <cmath>

#include "core/base/check.h"
#include "core/scene/cloth_section.h"
#include "core/scene/fabric_section.h"
#include "core/scene/method_section.h"
#include "core/scene/world_section.h"

namespace pleat {
namespace {

constexpr int kMaxLevel = 8;
constexpr double kMaxSteps = 1e9;  // a week of the fastest step; more is a mistake in the unit

int read_refinement(const JsonReader& reader, const Scene& scene) {
  reader.allow_keys({"level"});
  const auto at = reader.find("level");
  if (!at) return scene.level;
  const int level = static_cast<int>(at->integer(0, kMaxLevel));
  const auto* shape = std::get_if<SheetShape>(&scene.cloth);
  if (!shape && level > 0) at->fail("0, as inline particles cannot be refined");
  if (shape && n_sheet_vertices(*shape, level) > kMaxVertices)
    at->fail("a level with at most " + std::to_string(kMaxVertices) + " vertices");
  return level;
}

void check_run_length(const Scene& scene) {
  const double n_steps = scene.duration / scene.method.step;
  if (n_steps > kMaxSteps)
    throw InputError("/duration_s", "expected at most 1e9 steps of " +
                                        Json(scene.method.step).dump() + " s, got " +
                                        Json(n_steps).dump());
}

}  // namespace

Scene read_scene(std::string_view json_text, const FabricLibrary& fabrics) {
  const Json document = parse_json(json_text);
  const JsonReader root(document);
  root.allow_keys({"$schema", "name", "caption", "cloth", "fabric", "model", "refinement", "pins",
                   "world", "method", "duration_s", "record"});
  Scene scene;
  if (const auto at = root.find("$schema")) at->text();
  if (const auto at = root.find("name")) scene.name = at->text();
  if (const auto at = root.find("caption")) scene.caption = at->text();
  read_cloth(root.at("cloth"), scene);
  if (const auto at = root.find("fabric")) read_fabric(*at, fabrics, scene);
  if (const auto at = root.find("model")) read_model(*at, scene.model);
  if (const auto at = root.find("refinement")) scene.level = read_refinement(*at, scene);
  if (const auto at = root.find("pins")) read_pins(*at, scene);
  if (const auto at = root.find("world")) read_world(*at, scene);
  if (const auto at = root.find("method")) read_method(*at, scene.method);
  if (const auto at = root.find("duration_s")) scene.duration = at->number(kPositive);
  if (const auto at = root.find("record")) read_record(*at, scene.record);
  check_run_length(scene);
  return scene;
}

std::string write_scene(const Scene& scene) {
  return format_json({{"name", scene.name},
                      {"caption", scene.caption},
                      {"cloth", json_cloth(scene)},
                      {"fabric", json_fabric(scene)},
                      {"model", json_model(scene.model)},
                      {"refinement", {{"level", scene.level}}},
                      {"pins", json_pins(scene)},
                      {"world", json_world(scene)},
                      {"method", json_method(scene.method)},
                      {"duration_s", scene.duration},
                      {"record", json_record(scene.record)}});
}

}  // namespace pleat
