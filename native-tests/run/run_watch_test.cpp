#include "core/run/run_watch.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <limits>

#include "core/dynamics/stepper_table.h"
#include "core/run/timed_run.h"
#include "core/scene/format/scene_file.h"
#include "core/scene/format/scene_override.h"
#include "native-tests/support/assets.h"

using namespace pleat;

namespace {

/// A shipped scene with changes, {pointer: value}.
Scene changed(const std::string& name, const Json& changes) {
  Json json = parse_json(scene_text(name));
  std::vector<SceneOverride> overrides;
  for (const auto& change : changes.items()) overrides.push_back({change.key(), change.value()});
  override_scene(json, overrides);
  const auto folder = std::filesystem::path("assets/scenes/" + name).parent_path();
  const auto beside = [&](const std::string& file) {
    return repository_file((folder / file).string());
  };
  return read_scene(JsonReader(json), fabric_library(), beside);
}

/// The names of all scenes that come with the program.
std::vector<std::string> shipped_scenes() {
  const std::filesystem::path folder = repository_path("assets/scenes");
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".json")
      names.push_back(entry.path().lexically_relative(folder).replace_extension().generic_string());
  return names;
}

std::vector<RunWarning> warnings_of(const Scene& scene, double duration) {
  Simulation simulation(scene);
  TimedRun run(simulation, TimedRun::Parts::untimed);
  RunWatch watch(simulation);
  while (simulation.time() < duration && !run.has_ended()) watch.check(simulation, run.step());
  CHECK_FALSE(run.has_ended());
  watch.check_end(simulation);
  return watch.warnings();
}

Scene followed(const Scene& scene, const SettingHint& hint) {
  Json json = parse_json(write_scene(scene));
  const std::array<SceneOverride, 1> change = {{{hint.pointer, hint.value}}};
  override_scene(json, change);
  return read_scene(JsonReader(json), fabric_library());
}

/// The scene with what a warning says to try first.
Scene advised(const Scene& scene, const RunWarning& warning) {
  return followed(scene, warning.hints.front());
}

constexpr double kOnBall = 0.4;  // [s]

/// 33x33 vertices of silk, 1.1 m, that fall on a ball.
Scene on_ball(const Json& method) {
  return changed("ball", {{"/refinement/level", 1}, {"/method", method}});
}

double rms_stretch_at_end(const Scene& scene, double duration) {
  Simulation simulation(scene);
  while (simulation.time() < duration) simulation.step();
  return stretch(simulation.gauge(), simulation.state().positions).rms;
}

/// Quads of 6 mm, split; in every third of the lowest row a vertex lies 10 um above the border.
std::string obj_with_slivers(int cells) {
  std::string vertices, slivers, faces;
  int n_slivers = 0;
  const auto vertex = [](double x, double y) {
    return "v " + std::to_string(x) + " " + std::to_string(y) + " 0\n";
  };
  const auto face = [&](int a, int b, int c) {
    faces += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  };
  for (int row = 0; row <= cells; ++row)
    for (int column = 0; column <= cells; ++column) vertices += vertex(0.006 * column, 0.006 * row);
  for (int row = 0; row < cells; ++row)
    for (int column = 0; column < cells; ++column) {
      const int corner = 1 + row * (cells + 1) + column;
      const int across = corner + cells + 2;
      face(corner, across, across - 1);
      if (row > 0 || column % 3 != 2) {
        face(corner, corner + 1, across);
        continue;
      }
      slivers += vertex(0.006 * column + 0.0042, 1e-5);
      const int sliver = (cells + 1) * (cells + 1) + ++n_slivers;
      face(corner, corner + 1, sliver);
      face(corner + 1, across, sliver);
      face(across, corner, sliver);
    }
  return vertices + slivers + faces;
}

Json xpbd(int substeps) { return {{"stepper", "xpbd"}, {"substeps", substeps}}; }

}  // namespace

TEST_CASE("run_watch: shipped scenes in their own settings raise no warning", "[run][long]") {
  const auto name = GENERATE(from_range(shipped_scenes()));
  CAPTURE(name);
  const Scene scene = changed(name, Json::object());
  CHECK(warnings_of(scene, scene.body ? 0.5 : 1).empty());
}

// Runs of the list end as if all were well: warnings_of checks that.
TEST_CASE("run_watch: explosions that end ok are told", "[run][long]") {
  const Json explosions = parse_json(repository_file("native-tests/support/explosions.json"));
  REQUIRE(explosions.size() >= 20);
  for (const Json& explosion : explosions) {
    CAPTURE(explosion.dump());
    const Scene scene = changed(explosion.at("scene"), explosion.at("changes"));
    const std::vector<RunWarning> warnings = warnings_of(scene, explosion.at("seconds"));
    CHECK_FALSE(warnings.empty());
    for (const RunWarning& warning : warnings) {
      CHECK(warning.value > warning.bound);
      CHECK(warning.time > 0);
      CHECK_FALSE(warning.hints.empty());
    }
  }
}

TEST_CASE("run_watch: advice that is followed to the letter ends the warning", "[run]") {
  struct Case {
    const char* scene;
    Json method;
  };
  const Case one = GENERATE(values<Case>({
      {"curtain", xpbd(1)},
      {"curtain", {{"stepper", "pbd"}, {"iterations", 1}}},
      {"corners_meet", {{"stepper", "projective"}, {"iterations", 1}}},
      {"swinging_sheet", {{"stepper", "implicit"}, {"step_s", 0.1}}},
  }));
  CAPTURE(one.scene, one.method.dump());
  const Scene scene = changed(one.scene, {{"/method", one.method}, {"/refinement/level", 1}});
  const std::vector<RunWarning> warnings = warnings_of(scene, 1);
  REQUIRE_FALSE(warnings.empty());
  CAPTURE(advice(warnings.front()));
  CHECK(warnings_of(advised(scene, warnings.front()), 1).empty());
}

TEST_CASE("run_watch: nonsense is told before what did not converge, which takes a factor",
          "[run]") {
  Simulation simulation(
      changed("tablecloth", {{"/method", {{"stepper", "implicit"}}}, {"/refinement/level", 0}}));
  RunWatch watch(simulation);
  simulation.step();
  watch.check(simulation,
              {SolveStatus::not_converged, 2000, 0.01, "the iteration cap was reached"});
  const SolveReport well = simulation.step();
  simulation.start_from(30 * simulation.state().positions);
  watch.check(simulation, well);
  const std::vector<RunWarning>& warnings = watch.warnings();
  REQUIRE(warnings.size() == 2);
  CHECK(warnings.front().is_nonsense());
  CHECK_FALSE(warnings.back().is_nonsense());
  CHECK(advice(warnings.back()).rfind("try /method/solver = \"supernodal\"", 0) == 0);
}

TEST_CASE("run_watch: where cg gives up on slivers a factor solves, which is told", "[run]") {
  const auto beside = [](const std::string&) { return obj_with_slivers(20); };
  const Scene scene = read_scene(
      R"({"cloth": {"mesh": {"obj": "any.obj", "warp_direction": [0, -1, 0]}},
          "fabric": {"name": "fine cotton"}})",
      fabric_library(), beside);
  Simulation simulation(scene);
  RunWatch watch(simulation);
  for (int s = 0; s < 6; ++s) watch.check(simulation, simulation.step());
  CHECK(stretch(simulation.gauge(), simulation.state().positions).largest < 1e-6);
  REQUIRE(watch.warnings().size() == 1);
  const RunWarning& warning = watch.warnings().front();
  CHECK(warning.kind == RunWarning::Kind::given_up);
  CHECK_FALSE(warning.is_nonsense());
  CHECK(advice(warning) == "try /method/solver = \"supernodal\"");
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

// A swatch of 30 cm of chiffon that swings down from its upper edge: its weight, ten times, is
// worth 0.15 %. One linear step of 1/60 s turns its cells by more than threads follow.
TEST_CASE("run_watch: cloth that stretches like a softer one is told, and advice mends it",
          "[run]") {
  const auto* const type = GENERATE(&steppers::kImplicitEuler, &steppers::kHpbd);
  CAPTURE(type->name);
  Json json = parse_json(R"({"fabric": {"name": "chiffon"}, "pins": [{"part": "upper_edge"}],
      "cloth": {"sheet": {"width_m": 0.3, "height_m": 0.3, "columns": 12, "rows": 12,
                          "warp_direction": [0, 0, 1], "weft_direction": [1, 0, 0]}}})");
  json["method"] = {{"stepper", type->name}};
  const Scene scene = read_scene(JsonReader(json), fabric_library());
  const std::vector<RunWarning> warnings = warnings_of(scene, 0.25);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].kind == RunWarning::Kind::soft);
  CHECK_FALSE(warnings[0].is_nonsense());
  CHECK(warnings[0].bound < 0.004);
  CHECK(warnings[0].value > 0.005);
  CHECK(warnings_of(advised(scene, warnings[0]), 0.25).empty());
}

// A pendulum pulls by three weights at most, where its pins share them: 3.7 % of spandex of 60 cm.
// Two corners bear more on single threads than anyone knows.
TEST_CASE("run_watch: a level row of pins shares a swing, two corners do not", "[run]") {
  Json json = parse_json(R"({"fabric": {"name": "spandex"}, "pins": [{"part": "upper_edge"}],
      "cloth": {"sheet": {"width_m": 0.6, "height_m": 0.6, "columns": 12, "rows": 12,
                          "warp_direction": [0, 0, 1], "weft_direction": [1, 0, 0]}},
      "method": {"stepper": "hpbd"}})");
  const Scene row = read_scene(JsonReader(json), fabric_library());
  const double weight = 9.81 * Simulation(row).model().masses.sum();
  const double least_stiffness = std::min(row.fabric.stretch_warp, row.fabric.stretch_weft);
  const auto warnings = warnings_of(row, 0.25);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].kind == RunWarning::Kind::soft);
  CHECK(warnings[0].bound == Approx(0.002 + 3 * weight / (13 * 0.05 * least_stiffness)));
  json["pins"] = {{{"part", "upper_left"}}, {{"part", "upper_right"}}};
  CHECK(warnings_of(read_scene(JsonReader(json), fabric_library()), 0.25).empty());
}

// A sheet folded like a fan beside its pins falls until its threads are taut, which takes 0.3 s.
TEST_CASE("run_watch: a fall through slack explains the jerk that ends it", "[run]") {
  constexpr int kCells = 8;
  constexpr double kCell = 0.05;  // [m]
  Json json = parse_json(R"({"fabric": {"name": "linen"}, "pins": [{"part": "upper_edge"}],
      "cloth": {"sheet": {"width_m": 0.4, "height_m": 0.4, "columns": 8, "rows": 8,
                          "warp_direction": [0, -1, 0], "weft_direction": [1, 0, 0]}},
      "method": {"stepper": "implicit", "substeps": 16}})");
  Json places = Json::array();
  for (int row = 0; row <= kCells; ++row)
    for (int column = 0; column <= kCells; ++column)
      places.push_back({kCell * column, -0.1 * kCell * row, row % 2 * std::sqrt(0.99) * kCell});
  const bool is_folded = GENERATE(true, false);
  if (is_folded) json["start"]["positions_m"] = places;
  const Scene scene = read_scene(JsonReader(json), fabric_library());
  Simulation simulation(scene);
  RunWatch watch(simulation);
  double largest = 0;
  while (simulation.time() < 0.5) {
    watch.check(simulation, simulation.step());
    largest = std::max(largest, stretch(simulation.gauge(), simulation.state().positions).largest);
  }
  CAPTURE(largest);
  CHECK((largest > 0.003) == is_folded);
  CHECK(watch.warnings().empty());
}

// Stretched by a quarter at most, less than what legs wedge, but a twenty-fifth everywhere.
TEST_CASE("run_watch: cloth on a ball that stores more than it fell through is told", "[run]") {
  const auto* const type = GENERATE(&steppers::kPbd, &steppers::kHpbd);
  CAPTURE(type->name);
  const Scene scene = on_ball({{"stepper", type->name}});
  CHECK(rms_stretch_at_end(scene, kOnBall) > 0.03);
  const std::vector<RunWarning> warnings = warnings_of(scene, kOnBall);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].kind == RunWarning::Kind::soft);
  CHECK(warnings[0].value < 0.35);
  CHECK(warnings[0].bound < warnings[0].value);
  CHECK(warnings_of(advised(scene, warnings[0]), kOnBall).empty());
}

TEST_CASE("run_watch: advised substeps bring cloth on a ball near what it should be", "[run]") {
  const auto* const type = GENERATE(&steppers::kPbd, &steppers::kHpbd);
  CAPTURE(type->name);
  Scene scene = on_ball({{"stepper", type->name}});
  std::vector<RunWarning> warnings = warnings_of(scene, kOnBall);
  for (int change = 0; change < 3 && !warnings.empty(); ++change) {
    const auto& hints = warnings[0].hints;
    const auto more = std::find_if(hints.begin(), hints.end(), [](const SettingHint& hint) {
      return hint.pointer == "/method/substeps";
    });
    REQUIRE(more != hints.end());
    scene = followed(scene, *more);
    warnings = warnings_of(scene, kOnBall);
  }
  CHECK(warnings.empty());
  CHECK(rms_stretch_at_end(scene, kOnBall) < 0.01);
}

TEST_CASE("run_watch: cloth on a ball is no warning where its threads hold", "[run]") {
  const Json method = GENERATE(
      Json{{"stepper", "implicit"}}, Json{{"stepper", "implicit"}, {"substeps", 4}},
      Json{{"stepper", "newton"}}, xpbd(60), Json{{"stepper", "multigrid"}, {"substeps", 10}});
  CAPTURE(method.dump());
  const Scene scene = on_ball(method);
  CHECK(rms_stretch_at_end(scene, kOnBall) < 0.01);
  CHECK(warnings_of(scene, kOnBall).empty());
}

TEST_CASE("run_watch: a wreck that goes on with better settings is told as one", "[run]") {
  Simulation simulation(changed("swinging_sheet", {{"/refinement/level", 0}}));
  simulation.start_from(30 * simulation.state().positions);
  RunWatch watch(simulation);
  watch.check(simulation, simulation.step());
  REQUIRE_FALSE(watch.warnings().empty());
  CHECK(watch.warnings().front().kind == RunWarning::Kind::stretch);
}

TEST_CASE("run_watch: cloth that is thrown is fast from the start", "[run]") {
  const Scene thrown =
      changed("falling_sheet",
              {{"/refinement/level", 0}, {"/cloth/sheet/initial_velocity_m_per_s", {0, 30, 0}}});
  CHECK(warnings_of(thrown, 0.2).empty());
}

// Cloth lies 4 m from the line that a floor turns about, and is thrown at 24 m/s.
TEST_CASE("run_watch: a solid that turns explains the speed of what it throws", "[run]") {
  const Json json = parse_json(R"({
      "cloth": {"sheet": {"width_m": 0.4, "height_m": 0.4, "columns": 4, "rows": 4,
                          "origin_m": [4, 0.001, 0], "warp_direction": [0, 0, 1]}},
      "fabric": {"name": "linen"}, "method": {"stepper": "xpbd"},
      "world": {"gravity_m_per_s2": [0, 0, 0], "colliders": [{"plane": {},
          "motion": {"kind": "turn", "axis": [0, 0, 1], "rad_per_s": 6, "end_s": 9}}]}})");
  CHECK(warnings_of(read_scene(JsonReader(json), fabric_library()), 0.2).empty());
}

TEST_CASE("run_watch: what is left unsolved is told from the first of its steps on", "[run]") {
  Simulation simulation(changed("swinging_sheet", {{"/refinement/level", 0}}));
  RunWatch watch(simulation);
  SolveReport unsolved;
  unsolved.status = SolveStatus::not_converged;
  unsolved.relative_residual = 0.9;
  double since = 0;
  for (int look = 1; look <= 5; ++look) {
    simulation.step();
    if (look == 1) since = simulation.time();
    watch.check(simulation, unsolved);
    CAPTURE(look);
    // One such step is no nonsense, however much it left.
    CHECK(watch.warnings().front().is_nonsense() == (look == 5));
  }
  REQUIRE(watch.warnings().size() == 2);
  CHECK(watch.warnings().front().kind == RunWarning::Kind::unsolved);
  CHECK(watch.warnings().front().time == since);
}

// Cloth that falls freely has next to nothing to solve for, and leaves half of that.
TEST_CASE("run_watch: what one step leaves unsolved the next makes good", "[run]") {
  const Scene falling =
      changed("tablecloth",
              {{"/refinement/level", 0},
               {"/method", {{"stepper", "projective"}, {"substeps", 4}, {"iterations", 10}}}});
  CHECK(warnings_of(falling, 1).empty());
}

TEST_CASE("run_watch: warnings read back to what was written", "[run]") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<RunWarning> warnings = {
      {RunWarning::Kind::stretch, 0.4, VertexId(12), 1e15, 0.35, {{"/method/substeps", 4}}},
      {RunWarning::Kind::speed, 0.5, VertexId(3), kInfinity, 7, {{"/method/step_s", 0.01}}},
      {RunWarning::Kind::unsolved, 0.1, VertexId(0), 1e-3, 0.5, {}},
      {RunWarning::Kind::unbalanced, 2, VertexId(0), 0.34, 0.05, {}}};
  const std::string text = json_warnings(warnings).dump();
  const Json parsed = parse_json(text);
  const std::vector<RunWarning> read = read_warnings(JsonReader(parsed));
  REQUIRE(read.size() == 4);
  CHECK(read[1].value == kInfinity);
  CHECK(sentence(read[0]) == sentence(warnings[0]));
  CHECK(advice(read[1]) == advice(warnings[1]));
  CHECK(json_warnings(read).dump() == text);
  Json other = parsed;
  other[0]["kind"] = "odd";
  CHECK_THROWS_AS(read_warnings(JsonReader(other)), InputError);
}

TEST_CASE("run_watch: a step that stops below a thousandth is no warning", "[run]") {
  Simulation simulation(changed("swinging_sheet", {{"/refinement/level", 0}}));
  RunWatch watch(simulation);
  simulation.step();
  watch.check(simulation, {SolveStatus::not_converged, 50, 9e-4, "rounding stops the residual"});
  CHECK(watch.warnings().empty());
  watch.check(simulation, {SolveStatus::not_converged, 50, 2e-3, "the iteration cap was reached"});
  CHECK(watch.warnings().size() == 1);
}

// Cloth that falls, slides down a slope or lies on it has next to nothing to solve for; sooner or
// later all that is left of that is rounding.
TEST_CASE("run_watch: free fall, a slope and rest are no warning with any stepper", "[run]") {
  const auto* const type = GENERATE(from_range(standard_steppers()));
  const std::string world = GENERATE(
      std::string(R"({})"), std::string(R"({"colliders": [{"plane": {}, "friction": 0.5}]})"),
      std::string(R"({"gravity_m_per_s2": [4.605516, -8.661716, 0],
                      "colliders": [{"plane": {}, "friction": 0.5}]})"));
  CAPTURE(type->name, world);
  Json json = parse_json(R"({"fabric": {"name": "linen"}, "duration_s": 0.5})");
  json["cloth"]["sheet"] = {{"width_m", 0.2},
                            {"height_m", 0.2},
                            {"columns", 4},
                            {"rows", 4},
                            {"origin_m", {0, 0.0005, 0}},
                            {"warp_direction", {0, 0, 1}}};
  json["world"] = parse_json(world);
  json["method"] = {{"stepper", type->name}};
  const Scene scene = read_scene(JsonReader(json), fabric_library());
  CHECK(warnings_of(scene, 0.5).empty());
}

TEST_CASE("run_watch: what did not converge is told as that", "[run]") {
  const RunWarning warning{RunWarning::Kind::not_converged, 0.1, VertexId(0), 1e-5, 1e-3, {}};
  CHECK(sentence(warning) ==
        "from 0.1 s on, steps did not converge and left 0.001 % of their equations unsolved");
}

TEST_CASE("run_watch: cloth that rounds hold up is told by its share of the weight", "[run]") {
  const RunWarning warning{RunWarning::Kind::unbalanced, 2, VertexId(0), 0.34, 0.05, {}};
  CHECK_FALSE(warning.is_nonsense());
  CHECK(
      sentence(warning) ==
      "from 2 s on, cloth at rest was held up by what its steps leave unsolved, not by the cloth: "
      "34 % of its weight was unbalanced");
}

TEST_CASE("run_watch: a warning names its place, its bound and what to try", "[run]") {
  const RunWarning warning{RunWarning::Kind::stretch, 0.4, VertexId(12), 0.978, 0.35,
                           {{"/method/substeps", 4}}};
  CHECK(sentence(warning) ==
        "from 0.4 s at vertex 12 on, the cloth stretched by up to 97.8 %; its load explains 35 %");
  CHECK(advice(warning) == "try /method/substeps = 4");
  CHECK(json_warning(warning).at("hints").at("/method/substeps") == 4);
}
