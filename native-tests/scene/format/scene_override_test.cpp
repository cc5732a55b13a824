#include "core/scene/format/scene_override.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/dynamics/stepper_table.h"
#include "core/scene/format/method_section.h"
#include "core/scene/format/scene_file.h"
#include "native-tests/support/assets.h"

using namespace pleat;

namespace {

/// The scene's text after the changes, an object of pointers and values.
std::string overridden(const std::string& scene_text, const std::string& changes_text) {
  Json scene = parse_json(scene_text);
  std::vector<SceneOverride> changes;
  const Json pairs = parse_json(changes_text);
  for (const auto& change : pairs.items()) changes.push_back({change.key(), change.value()});
  override_scene(scene, changes);
  return scene.dump();
}

}  // namespace

TEST_CASE("scene override: a value is set where its pointer leads", "[scene]") {
  CHECK(overridden(R"({"a": {"b": 1}})", R"({"/a/b": 2})") == R"({"a":{"b":2}})");
  CHECK(overridden(R"({})", R"({"/a/b": 2})") == R"({"a":{"b":2}})");
  CHECK(overridden(R"({"a": {"b": 1}})", R"({"/a": {"c": 3}})") == R"({"a":{"c":3}})");
  CHECK(overridden(R"({"a": [[1, 2], 3]})", R"({"/a/0/1": 4})") == R"({"a":[[1,4],3]})");
  CHECK(overridden(R"({})", R"({"/x~1y~0": 1})") == R"({"x/y~":1})");
  CHECK(overridden(R"({"a": 1})", R"({"/a/b": 2})") == R"({"a":1})");
  CHECK(overridden(R"([1])", R"({"/a/b": 2})") == "[1]");
}

TEST_CASE("scene override: sections come before their parts, whatever the order", "[scene]") {
  const std::string whole = R"({"method":{"stepper":"xpbd","substeps":7}})";
  CHECK(overridden("{}", R"({"/method/substeps": 7, "/method": {"stepper": "xpbd"}})") == whole);
  CHECK(overridden("{}", R"({"/method": {"stepper": "xpbd"}, "/method/substeps": 7})") == whole);
  CHECK(overridden("{}", R"({"/method/substeps": 7, "/method/stepper": "explicit"})") ==
        R"({"method":{"stepper":"explicit","substeps":7}})");
}

TEST_CASE("scene override: another stepper starts from its own settings, in the scene's steps",
          "[scene]") {
  const std::string scene = R"({"method": {"step_s": 0.01, "stepper": "implicit", "substeps": 4,
                                           "solver": "cg", "tolerance": 0.01}})";
  CHECK(overridden(scene, R"({"/method/stepper": "xpbd"})") ==
        R"({"method":{"step_s":0.01,"stepper":"xpbd"}})");
  CHECK(overridden(scene, R"({"/method/substeps": 60, "/method/stepper": "xpbd"})") ==
        R"({"method":{"step_s":0.01,"stepper":"xpbd","substeps":60}})");
  const std::string stable = R"({"method": {"stepper": "explicit", "substeps": "stable"}})";
  CHECK(overridden(stable, R"({"/method/stepper": "explicit"})") ==
        R"({"method":{"stepper":"explicit","substeps":"stable"}})");
  // implicit, which a scene that names none has.
  const std::string unnamed = R"({"method": {"substeps": 3}})";
  CHECK(overridden(unnamed, R"({"/method/stepper": "implicit"})") ==
        R"({"method":{"substeps":3,"stepper":"implicit"}})");
  CHECK(overridden(unnamed, R"({"/method/stepper": "rk4"})") == R"({"method":{"stepper":"rk4"}})");
  for (const StepperType* type : standard_steppers()) {
    CAPTURE(type->name);
    if (type == MethodOptions{}.stepper) continue;
    const std::string changed =
        overridden(scene, R"({"/method/stepper": ")" + std::string(type->name) + "\"}");
    const Json read = parse_json(changed);
    MethodOptions usual = type->usual_method();
    usual.step = 0.01;
    CHECK(json_method(read_method(JsonReader(read).at("method"), standard_steppers())) ==
          json_method(usual));
  }
}

TEST_CASE("scene override: another fabric leaves out the scene's own numbers", "[scene]") {
  CHECK(overridden(R"({"fabric": {"shear_n_per_m": 3}})", R"({"/fabric/name": "silk"})") ==
        R"({"fabric":{"name":"silk"}})");
  CHECK(overridden(R"({"fabric": {"name": "wool", "bending": "moving", "overrides": {}}})",
                   R"({"/fabric/overrides/shear_n_per_m": 2, "/fabric/name": "silk"})") ==
        R"({"fabric":{"bending":"moving","name":"silk","overrides":{"shear_n_per_m":2}}})");
}

TEST_CASE("scene override: every shipped scene takes every stepper and fabric", "[scene]") {
  const std::string scene = GENERATE(from_range(std::begin(kSceneFiles), std::end(kSceneFiles)));
  const std::string stepper = GENERATE("explicit", "implicit", "projective", "xpbd");
  CAPTURE(scene, stepper);
  const std::string text = overridden(
      scene_text(scene), R"({"/fabric/name": "silk", "/method/stepper": ")" + stepper + "\"}");
  const Scene read = read_scene(text, fabric_library());
  CHECK(read.method.stepper->name == stepper);
  CHECK(read.fabric.name == "silk");
}

TEST_CASE("scene override: what leads nowhere is refused with its pointer", "[scene]") {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "/a";
  for (const std::string& pointer :
       {std::string(), std::string("a"), std::string("/a~"), std::string("/a~2"),
        std::string("/list/1"), std::string("/list/x"), std::string("/list/-1"), deep}) {
    Json scene = parse_json(R"({"list": [0]})");
    const SceneOverride change{pointer, 1};
    CAPTURE(pointer.size());
    try {
      override_scene(scene, {&change, 1});
      FAIL("accepted");
    } catch (const InputError& error) {
      CHECK(error.where() == cut(pointer));
    }
  }
}

TEST_CASE("scene override: another solver leaves out what is of no effect beside it", "[scene]") {
  const std::string sor = R"({"method": {"stepper": "imex", "solver": "sor", "omega": 0.5}})";
  CHECK(overridden(sor, R"({"/method/solver": "supernodal"})") ==
        R"({"method":{"stepper":"imex","solver":"supernodal"}})");
  CHECK(overridden(sor, R"({"/method/omega": 0.7, "/method/solver": "sor"})") ==
        R"({"method":{"stepper":"imex","solver":"sor","omega":0.7}})");
  const std::string jacobi =
      R"({"method":{"omega":0.5,"smoother_before":"jacobi","stepper":"multigrid"}})";
  CHECK(overridden(jacobi, R"({"/method/solver": "cg"})").find("omega") != std::string::npos);
}
