#include "core/run/run_watch.h"

#include <catch2/catch.hpp>

#include "core/dynamics/stepper_table.h"
#include "core/run/timed_run.h"
#include "core/scene/scene_file.h"
#include "core/scene/scene_override.h"
#include "native-tests/support/assets.h"

using namespace pleat;

namespace {

/// A shipped scene with changes, {pointer: value}.
Scene changed(const std::string& name, const Json& changes) {
  Json json = parse_json(scene_text(name));
  std::vector<SceneOverride> overrides;
  for (const auto& change : changes.items()) overrides.push_back({change.key(), change.value()});
  override_scene(json, overrides);
  return read_scene(JsonReader(json), fabric_library());
}

std::vector<RunWarning> warnings_of(const Scene& scene, double duration) {
  Simulation simulation(scene);
  TimedRun run(simulation, TimedRun::Parts::untimed);
  RunWatch watch(simulation);
  while (simulation.time() < duration && !run.has_ended()) watch.look(simulation, run.step());
  CHECK_FALSE(run.has_ended());
  return watch.warnings();
}

bool has(const std::vector<RunWarning>& warnings, RunWarning::Kind kind) {
  for (const RunWarning& warning : warnings)
    if (warning.kind == kind) return true;
  return false;
}

Json xpbd(int substeps) { return {{"stepper", "xpbd"}, {"substeps", substeps}}; }

}  // namespace

TEST_CASE("run_watch: shipped scenes in their own settings raise no warning", "[run]") {
  const std::string name = GENERATE(as<std::string>(), "curtain", "swinging_sheet", "tablecloth",
                                    "falling_sheet", "hanging_chain", "spring_pendulum");
  CAPTURE(name);
  CHECK(warnings_of(changed(name, Json::object()), 1).empty());
}

TEST_CASE("run_watch: explosions that end ok are told", "[run]") {
  struct Explosion {
    const char* scene;
    Json changes;
  };
  const Json one_round = {{"stepper", "projective"}, {"iterations", 1}, {"substeps", 1}};
  const auto explosion = GENERATE_COPY(from_range(std::vector<Explosion>{
      {"curtain", {{"/method", xpbd(1)}}},
      {"curtain", {{"/method", xpbd(1)}, {"/fabric/name", "silk"}}},
      {"curtain", {{"/method", xpbd(1)}, {"/refinement/level", 1}}},
      {"tablecloth", {{"/method", xpbd(1)}, {"/fabric/name", "leather"}}},
      {"tablecloth", {{"/method", xpbd(2)}, {"/fabric/name", "canvas"}}},
      {"tablecloth", {{"/method", one_round}}},
      {"tablecloth", {{"/method", one_round}, {"/fabric/name", "wool"}}},
      {"swinging_sheet", {{"/method", xpbd(1)}}},
      {"swinging_sheet", {{"/method", xpbd(1)}, {"/fabric/name", "linen"}}},
      {"swinging_sheet", {{"/world/gravity_m_per_s2", {0, -1e6, 0}}}},
  }));
  CAPTURE(explosion.scene, explosion.changes.dump());
  const std::vector<RunWarning> warnings =
      warnings_of(changed(explosion.scene, explosion.changes), 1);
  CHECK_FALSE(warnings.empty());
  for (const RunWarning& warning : warnings) {
    CHECK(warning.value > warning.bound);
    CHECK(warning.time > 0);
    CHECK_FALSE(warning.hints.empty());
  }
}

TEST_CASE("run_watch: a hint taken again and again ends the warning", "[run]") {
  Scene scene = changed("tablecloth", {{"/method", xpbd(1)}, {"/refinement/level", 1}});
  int n_hints = 0;
  for (auto warnings = warnings_of(scene, 1); has(warnings, RunWarning::Kind::stretch);
       warnings = warnings_of(scene, 1)) {
    REQUIRE(++n_hints <= 4);
    Json json = parse_json(write_scene(scene));
    std::vector<SceneOverride> overrides;
    for (const SettingHint& hint : warnings.front().hints)
      overrides.push_back({hint.pointer, hint.value});
    override_scene(json, overrides);
    scene = read_scene(JsonReader(json), fabric_library());
  }
  CHECK(n_hints > 0);
}

TEST_CASE("run_watch: pins that pull cloth apart explain its stretch", "[run]") {
  Json json = parse_json(scene_text("swinging_sheet"));
  json["world"]["gravity_m_per_s2"] = {0, 0, 0};
  const auto part = [](const char* name, double by) {
    return Json{
        {"part", name},
        {"motion", {{"kind", "ease"}, {"offset_m", {0, 0, by}}, {"begin_s", 0}, {"end_s", 0.5}}}};
  };
  json["pins"] = Json::array({part("upper_edge", -0.4), part("lower_edge", 0.4)});
  json["refinement"]["level"] = 0;
  const Scene scene = read_scene(JsonReader(json), fabric_library());
  CHECK(warnings_of(scene, 0.5).empty());
}

TEST_CASE("run_watch: a warning names its place, its bound and what to try", "[run]") {
  const RunWarning warning{RunWarning::Kind::stretch, 0.4, VertexId(12), 0.978, 0.35,
                           {{"/method/substeps", 4}}};
  CHECK(sentence(warning) ==
        "from 0.4 s at vertex 12 on, the cloth stretched by up to 97.8 %; its load explains 35 %");
  CHECK(advice(warning) == "try /method/substeps = 4");
  CHECK(json_warning(warning).at("hints").at("/method/substeps") == 4);
}
