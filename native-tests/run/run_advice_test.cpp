#include "core/run/run_advice.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "core/dynamics/stepper_table.h"
#include "core/scene/format/scene_file.h"
#include "core/scene/format/scene_override.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

using Kind = RunWarning::Kind;

Json sheet_with(const std::string& method) {
  return parse_json(R"({"cloth": {"sheet": {"columns": 2, "rows": 2}},
                        "pins": [{"part": "upper_edge"}], "method": )" +
                    method + "}");
}

Scene read(const Json& json) { return read_scene(JsonReader(json), fabric_library()); }

/// The scene with what a warning advises, followed to the letter.
Scene followed(Json json, const SettingHint& hint) {
  const SceneOverride change{hint.pointer, hint.value};
  override_scene(json, {&change, 1});
  return read(json);
}

}  // namespace

TEST_CASE("run_advice: whatever is advised can be read", "[run]") {
  const std::string method =
      GENERATE(std::string(R"({"stepper": "imex", "solver": "sor", "omega": 0.05})"),
               R"({"stepper": "implicit", "solver": "cg", "preconditioner": "incomplete_factor"})",
               R"({"stepper": "projective", "iterations": 30000})",
               R"({"stepper": "xpbd", "substeps": 900000})", R"({"stepper": "pbd", "step_s": 1e9})",
               R"({"stepper": "explicit", "substeps": 4, "beyond_bound": "go_on"})",
               R"({"stepper": "newton", "rule": "midpoint", "step_s": 0.1})");
  const Kind kind = GENERATE(Kind::stretch, Kind::speed, Kind::unsolved, Kind::not_converged,
                             Kind::given_up, Kind::unbalanced, Kind::soft);
  CAPTURE(method, static_cast<int>(kind));
  const Json json = sheet_with(method);
  const Scene scene = read(json);
  if (kind == Kind::given_up && !scene.method.stepper->reads("solver")) return;  // has none
  for (const SettingHint& hint : hints_for(kind, 100, scene)) {
    CAPTURE(hint.pointer, hint.value.dump());
    CHECK_NOTHROW(followed(json, hint));
  }
}

TEST_CASE("run_advice: steps of an equal length stay, as frames and references ask for them",
          "[run]") {
  const Json json = sheet_with(R"({"stepper": "pbd", "step_s": 0.025, "iterations": 1000})");
  bool is_offered = false;
  for (const SettingHint& hint : hints_for(Kind::stretch, 2, read(json))) {
    const Scene scene = followed(json, hint);
    CHECK(scene.method.step == 0.025);
    is_offered = is_offered || scene.method.stepper == &steppers::kImplicitEuler;
  }
  CHECK(is_offered);
}

// 4 e of errors that fall with 1/n^2, and with 1/n^1.5 where sweeps are taken.
TEST_CASE("run_advice: substeps grow by as much as what is wrong asks for", "[run]") {
  struct Case {
    const char* method;
    double excess;
    int substeps;
  };
  const Case one = GENERATE(values<Case>({{R"({"stepper": "imex", "substeps": 4})", 3.9, 16},
                                          {R"({"stepper": "imex", "substeps": 4})", 5, 32},
                                          {R"({"stepper": "pbd", "substeps": 8})", 1.9, 32},
                                          {R"({"stepper": "pbd", "substeps": 8})", 8, 128}}));
  CAPTURE(one.method, one.excess);
  CHECK(hints_for(Kind::soft, one.excess, read(sheet_with(one.method))).back().value ==
        one.substeps);
}

TEST_CASE("run_advice: rounds that would have to grow by more than they may give way to implicit",
          "[run]") {
  const auto is_offered = [](const char* pointer, double excess) {
    const Scene scene = read(sheet_with(R"({"stepper": "projective", "iterations": 10})"));
    const auto hints = hints_for(Kind::soft, excess, scene);
    return std::any_of(hints.begin(), hints.end(),
                       [&](const SettingHint& hint) { return hint.pointer == pointer; });
  };
  CHECK(is_offered("/method/iterations", 3.9));
  CHECK_FALSE(is_offered("/method/iterations", 4.1));
  CHECK(is_offered("/method", 3.9));
  CHECK(is_offered("/method", 4.1));
}

TEST_CASE("run_advice: too few substeps for the bound are to be as many as are stable", "[run]") {
  const auto hints = [](const std::string& method) {
    return hints_for(Kind::stretch, 2, read(sheet_with(method)));
  };
  const auto beyond = hints(R"({"stepper": "rk4", "substeps": 4, "beyond_bound": "go_on"})");
  REQUIRE(beyond.size() == 1);
  CHECK(beyond[0].value == "stable");
}

}  // namespace pleat
