#include "core/scene/format/scene_file.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/files/plan_file.h"
#include "core/scene/format/cloth_section.h"
#include "core/scene/format/fabric_section.h"
#include "core/scene/format/method_section.h"
#include "core/scene/format/model_section.h"
#include "core/scene/format/start_section.h"
#include "core/scene/format/world_section.h"
#include "core/scene/rest_cloth.h"
#include "core/scene/tearing.h"

namespace pleat {
namespace {

/// The plan of a scene's "refinement": written out, or the name of its file. The scene's cloth and
/// model have been read.
RefinementPlan read_scene_plan(const JsonReader& reader, const FileSource& files,
                               const Scene& scene) {
  const auto base = base_quads(scene);
  if (!base) reader.fail("no plan, as only a sheet or a garment is refined by one");
  if (scene.model.elasticity == Elasticity::membrane)
    reader.fail("no plan with a membrane, as only springs hold hanging vertices");
  const bool is_file = reader.is_text();
  if (is_file && !files) reader.fail("a plan written out, as no files can be read here");
  const auto checked = [&base](RefinementPlan plan) {
    planned_mesh(*base, plan);
    return plan;
  };
  if (is_file)
    return read_named_file(reader, files,
                           [&](const std::string& text) { return checked(read_plan(text)); });
  try {
    return checked(read_plan(reader));
  } catch (const InputError& error) {
    if (error.where().rfind(reader.pointer(), 0) == 0) throw;
    throw InputError(reader.pointer() + error.where(), error.sentence());
  }
}

void read_refinement(const JsonReader& reader, const FileSource& files, Scene& scene) {
  reader.allow_keys({"level", "plan"});
  if (const auto at = reader.find("plan")) {
    if (reader.find("level")) at->fail("no such key beside a level");
    scene.plan = read_scene_plan(*at, files, scene);
  } else if (const auto level = reader.find("level")) {
    scene.level = static_cast<int>(level->integer(0, kMaxLevel));
    check_level(scene, scene.level, level->pointer());
  }
}

Json json_refinement(const Scene& scene) {
  Json json;
  if (scene.plan)
    json["plan"] = json_plan(*scene.plan);
  else
    json["level"] = scene.level;
  return json;
}

}  // namespace

void check_duration(double duration, double step) {
  const double n_steps = duration / step;
  if (n_steps > static_cast<double>(kMaxSteps))
    throw InputError("/duration_s", "expected at most 1e9 steps of " + Json(step).dump() +
                                        " s, got " + Json(n_steps).dump() + " steps");
}

std::int64_t whole_steps(double duration, double step) {
  const double n_steps = std::min(duration / step, static_cast<double>(kMaxSteps));
  return std::max<std::int64_t>(1, std::llround(n_steps));
}

Scene read_scene(std::string_view json_text, const FabricLibrary& fabrics, const FileSource& files,
                 const SceneTables& tables) {
  const Json document = parse_json(json_text);
  return read_scene(JsonReader(document), fabrics, files, tables);
}

Scene read_scene(const JsonReader& root, const FabricLibrary& fabrics, const FileSource& files,
                 const SceneTables& tables) {
  root.allow_keys({"$schema", "name", "caption", "cloth", "fabric", "model", "figure", "refinement",
                   "pins", "world", "method", "duration_s", "record", "start"});
  Scene scene;
  if (const auto at = root.find("$schema")) at->text();
  if (const auto at = root.find("name")) scene.name = at->text();
  if (const auto at = root.find("caption")) scene.caption = at->text();
  if (const auto at = root.find("figure")) scene.body = read_body(*at, files);
  read_cloth(root.at("cloth"), files, tables.cloths, scene);
  if (const auto at = root.find("fabric")) read_fabric(*at, fabrics, scene);
  scene.model = usual_model(scene);
  if (const auto at = root.find("model")) read_model(*at, scene);
  if (const auto at = root.find("refinement")) read_refinement(*at, files, scene);
  if (const auto at = root.find("pins")) read_pins(*at, scene);
  if (const auto at = root.find("world")) read_world(*at, files, scene);
  if (const auto at = root.find("method")) scene.method = read_method(*at, tables.steppers);
  if (const auto at = root.find("duration_s")) scene.duration = at->number(kPositive);
  if (const auto at = root.find("record")) read_record(*at, scene.record);
  check_duration(scene.duration, scene.method.step);
  if (const auto at = root.find("start")) scene.start = read_start(*at, files, scene);
  if (scene.model.tearing) check_tearing(root.at("model").at("tearing"), scene);
  return scene;
}

std::string write_scene(const Scene& scene) {
  Json json;
  json["name"] = scene.name;
  json["caption"] = scene.caption;
  json["cloth"] = json_cloth(scene);
  json["fabric"] = json_fabric(scene);
  json["model"] = json_model(scene.model);
  json["refinement"] = json_refinement(scene);
  json["pins"] = json_pins(scene);
  json["world"] = json_world(scene);
  json["method"] = json_method(scene.method);
  json["duration_s"] = scene.duration;
  json["record"] = json_record(scene.record);
  if (scene.body) json["figure"] = json_body(*scene.body);
  if (scene.start) json["start"] = json_start(*scene.start);
  return format_json(json);
}

}  // namespace pleat
