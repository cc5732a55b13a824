// A stepper that is added to the table and named nowhere else.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <string>

#include "core/base/check.h"
#include "core/dynamics/method_settings.h"
#include "core/run/simulation.h"
#include "core/scene/format/method_section.h"
#include "core/scene/format/scene_file.h"
#include "core/scene/format/scene_override.h"
#include "core/sweep/front_chart.h"
#include "core/sweep/sweep.h"
#include "core/sweep/usual_settings.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/scene_schema.h"

namespace pleat {
namespace {

constexpr auto kSettings = method_settings("substeps", "iterations");
constexpr std::array<MethodCounts, 2> kCounts = {{{3, 2}, {7, 2}}};

StepperType made_up() {
  StepperType type = steppers::kImplicitEuler;
  type.name = "made_up";
  type.title = "Made up";
  type.meaning = "Nobody has heard of it.";
  type.settings = kSettings;
  type.start = {5, 2};
  type.usual_counts = kCounts;
  type.mark = {"M-1-2L3 4Z", "#123456", "#fedcba"};
  return type;
}

const StepperType kMadeUp = made_up();
const std::array<const StepperType*, 3> kTable = {&steppers::kImplicitEuler, &kMadeUp,
                                                  &steppers::kXpbd};

const std::string kScene =
    R"({"cloth": {"sheet": {"columns": 2, "rows": 2}}, "pins": [{"part": "upper_edge"}],
        "method": {"stepper": "made_up"}})";

Scene read(const JsonReader& scene) {
  return read_scene(scene, fabric_library(), {}, {.steppers = kTable});
}

Scene scene_of(std::string_view text) {
  return read_scene(text, fabric_library(), {}, {.steppers = kTable});
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("stepper table: a scene takes an added stepper with its own start and runs by it",
          "[sweep]") {
  const Scene scene = scene_of(kScene);
  CHECK(scene.method.stepper == &kMadeUp);
  CHECK(scene.method.substeps == 5);
  CHECK(scene.method.iterations == 2);
  Simulation simulation(scene);
  CHECK(simulation.step().ok());
  CHECK(simulation.substeps() == 5);
  CHECK(scene_of(write_scene(scene)).method.stepper == &kMadeUp);
}

TEST_CASE("stepper table: a scene that names what the table lacks is told what it has", "[sweep]") {
  try {
    read_scene(kScene, fabric_library());
    FAIL("accepted");
  } catch (const InputError& error) {
    CHECK(error.where() == "/method/stepper");
    CHECK(error.sentence() ==
          "expected one of \"implicit\", \"imex\", \"projective\", \"xpbd\", \"pbd\", \"hpbd\", "
          "\"multigrid\", \"explicit\", \"rk4\", "
          "\"newton\", got \"made_up\"");
  }
}

TEST_CASE("stepper table: settings that a stepper does not read are refused with their pointer",
          "[sweep]") {
  for (const StepperType* type : standard_steppers()) {
    const Json usual = json_method(type->usual_method());
    for (const MethodSetting& setting : kMethodSettings) {
      const char* key = setting.key;
      CAPTURE(type->name, key);
      const bool is_beside_a_factor =
          key == std::string("preconditioner") && is_direct(type->usual_method().solver);
      CHECK(usual.contains(key) == (type->reads(key) && !is_beside_a_factor));
      if (type->reads(key)) continue;
      Json scene = parse_json(kScene);
      scene["method"] = {{"stepper", type->name}, {key, 1}};
      try {
        read_scene(scene.dump(), fabric_library());
        FAIL("accepted");
      } catch (const InputError& error) {
        CHECK(error.where() == std::string("/method/") + key);
        CHECK(has(error.sentence(), std::string(type->name) + " does not read it"));
      }
    }
  }
}

TEST_CASE("stepper table: an added stepper in a scene leaves out another's settings", "[sweep]") {
  Json scene = parse_json(
      R"({"method": {"stepper": "implicit", "solver": "cg", "tolerance": 0.1, "substeps": 3}})");
  const SceneOverride change{"/method/stepper", "made_up"};
  override_scene(scene, {&change, 1}, kTable);
  CHECK(scene["method"] == Json{{"stepper", "made_up"}});
}

TEST_CASE("stepper table: schema, help and page say what an added stepper is", "[sweep]") {
  const Json method = scene_schema(kTable)["properties"]["method"];
  CHECK(method["properties"]["stepper"]["enum"] == Json::array({"implicit", "made_up", "xpbd"}));
  CHECK(method["oneOf"][1]["properties"]["substeps"]["default"] == 5);
  CHECK(method["oneOf"][1]["properties"].size() == 4);
  CHECK(stepper_names(kTable) == "implicit, made_up, xpbd");
  CHECK(has(stepper_help(kTable), "made_up   Nobody has heard of it.\n"));
  const Json row = json_steppers(kTable)[1];
  CHECK(row["name"] == "made_up");
  CHECK(row["title"] == "Made up");
  CHECK(row["settings"]["iterations"]["start"] == 2);
  CHECK(row["sweep"] ==
        Json::array({{{"substeps", 3}, {"iterations", 2}}, {{"substeps", 7}, {"iterations", 2}}}));
  CHECK(row["mark"] == "M-1-2L3 4Z");
  CHECK(row["dark_colour"] == "#fedcba");
}

TEST_CASE("stepper table: a sweep measures an added stepper and its figure draws its mark",
          "[sweep]") {
  const Scene scene = scene_of(kScene);
  const auto usual = usual_steppers(kTable, scene);
  REQUIRE(std::find(usual.begin(), usual.end(), &kMadeUp) != usual.end());
  Json settings = Json::array();
  for (const MethodOptions& method : usual_settings(kMadeUp, scene.method))
    settings.push_back({{"/method", json_method(method)}});
  const Json plan = {
      {"scene", parse_json(kScene)}, {"settings", settings}, {"duration_s", 0.1}, {"repeats", 1}};
  MemoryReferenceStore store;
  Sweep sweep(read_sweep_plan(JsonReader(plan), read, kTable), store, "test");
  std::string journal;
  sweep.on_run([&](const std::string& line) { journal += line; });
  while (!sweep.done()) sweep.advance(1);
  REQUIRE(sweep.rows().size() == 2);
  for (const BenchRow& row : sweep.rows()) CHECK(row.method.stepper == &kMadeUp);
  CHECK(sweep.rows()[1].n_substeps == 7);
  const Json row = json_bench_row(sweep.rows()[0]);
  CHECK(read_bench_row(JsonReader(row), kTable).method.stepper == &kMadeUp);
  const std::string chart = front_chart(sweep.rows());
  CHECK(has(chart, "M-1-2L3 4Z\" fill=\"#123456\""));
  CHECK(has(chart, ">made_up</text>"));

  Sweep again(read_sweep_plan(JsonReader(plan), read, kTable), store, "test");
  CHECK(again.resume(journal) == journal.size());
  CHECK(again.done());
}

}  // namespace pleat
