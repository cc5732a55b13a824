// Settings that a stepper of the table reads and that are named nowhere else.
#include <array>
#include <catch2/catch.hpp>
#include <set>
#include <string>

#include "core/base/check.h"
#include "core/dynamics/method_settings.h"
#include "core/scene/format/method_section.h"
#include "core/scene/format/scene_file.h"
#include "core/scene/format/scene_override.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/places.h"
#include "native-tests/support/scene_schema.h"

// A namespace of its own, as test files of a folder may stand in one unit.
namespace pleat::made_up_setting {
namespace {

constexpr MethodSetting kWobble = {
    "wobble", ShareField{&MethodOptions::explicit_share, {0, 0.5}, 20, {"never"}}, "Wobble, share",
    "Nobody has heard of it."};
constexpr MethodSetting kLeash = {"leash", word_field<&MethodOptions::attachments>(kAttachments)};
constexpr MethodSetting kRopes = {"ropes", CountField{&MethodOptions::levels, {2, 9}}};
constexpr std::array kSettings = {method_settings("substeps")[0], &kWobble, &kLeash, &kRopes};

StepperType made_up() {
  StepperType type = steppers::kImplicitEuler;
  type.name = "made_up";
  type.settings = kSettings;
  type.set_start = [](MethodOptions& method) { method.levels = 4; };
  return type;
}

const StepperType kMadeUp = made_up();
const std::array<const StepperType*, 2> kTable = {&steppers::kImplicitEuler, &kMadeUp};

Scene scene_of(const Json& method) {
  const Json scene = {{"cloth", {{"sheet", {{"columns", 2}, {"rows", 2}}}}}, {"method", method}};
  return read_scene(scene.dump(), fabric_library(), {}, {.steppers = kTable});
}

std::string refusal_of(const Json& method) {
  try {
    scene_of(method);
    return "";
  } catch (const InputError& error) {
    return error.where() + ": " + error.sentence();
  }
}

}  // namespace

TEST_CASE("method settings: a scene's added settings are read and written", "[sweep]") {
  const Json given = {
      {"stepper", "made_up"}, {"wobble", 0.25}, {"leash", "long_range"}, {"ropes", 3}};
  const MethodOptions method = scene_of(given).method;
  CHECK(method.explicit_share == 0.25);
  CHECK(method.attachments == Attachments::long_range);
  CHECK(method.levels == 3);
  const Json written = json_method(method);
  CHECK(written.dump() ==
        R"({"stepper":"made_up","step_s":0.016666666666666666,"substeps":1,"wobble":0.25,)"
        R"("leash":"long_range","ropes":3})");
  CHECK(json_method(scene_of(written).method) == written);
  const Json usual = json_method(scene_of({{"stepper", "made_up"}}).method);
  CHECK(usual["wobble"] == "never");
  CHECK(usual["leash"] == "none");
  CHECK(usual["ropes"] == 4);
}

TEST_CASE("method settings: values that an added row does not take are refused with its pointer",
          "[sweep]") {
  const auto refusal = [](const char* key, const Json& value) {
    return refusal_of({{"stepper", "made_up"}, {key, value}});
  };
  CHECK(refusal("wobble", 0.5).empty());
  CHECK(refusal("wobble", "never").empty());
  CHECK(refusal("wobble", 0.6) == "/method/wobble: expected a number between 0.0 and 0.5, got 0.6");
  CHECK(refusal("wobble", "often") ==
        "/method/wobble: expected a number or \"never\", got \"often\"");
  CHECK(refusal("leash", "short") ==
        "/method/leash: expected one of \"none\", \"long_range\", got \"short\"");
  CHECK(refusal("ropes", 1) == "/method/ropes: expected a whole number from 2 to 9, got 1");
  CHECK(refusal("robes", 3) == "/method/robes: expected the key \"ropes\", got \"robes\"");
  CHECK(refusal_of({{"ropes", 3}}) ==
        "/method/ropes: expected no such key, as implicit does not read it, got 3");
  MethodOptions method = kMadeUp.usual_method();
  CHECK_NOTHROW(method.validate());
  method.levels = 1;
  CHECK_THROWS_AS(method.validate(), ContractError);
  method.levels = 2;
  method.explicit_share = 0.6;
  CHECK_THROWS_AS(method.validate(), ContractError);
}

TEST_CASE("method settings: another stepper in a scene leaves this one's settings out", "[sweep]") {
  Json scene = parse_json(R"({"method": {"stepper": "made_up", "wobble": 0.1, "substeps": 3}})");
  const SceneOverride change{"/method/stepper", "implicit"};
  override_scene(scene, {&change, 1}, kTable);
  CHECK(scene["method"] == Json{{"stepper", "implicit"}});
}

TEST_CASE("method settings: schema, help and page say what an added setting is", "[sweep]") {
  const std::string help = stepper_help(kTable);
  CHECK(help.find("reads substeps, wobble, leash, ropes\n") != std::string::npos);
  CHECK(json_steppers(kTable)[1]["details"] == Json{{"wobble", "never"}});
  CHECK(json_method_details(kTable).back() == Json{{"key", "wobble"},
                                                   {"title", "Wobble, share"},
                                                   {"meaning", "Nobody has heard of it."},
                                                   {"least", 0.0},
                                                   {"most", 0.5},
                                                   {"step", 0.05}});
  const Json method = scene_schema(kTable)["properties"]["method"];
  CHECK(method["properties"]["leash"]["enum"] == Json::array({"none", "long_range"}));
  CHECK(method["properties"]["ropes"]["maximum"] == 9);
  CHECK(method["oneOf"][1]["properties"]["ropes"]["default"] == 4);
  CHECK_FALSE(method["oneOf"][0]["properties"].contains("ropes"));
}

TEST_CASE("method settings: one more is named in five places, beside what it does", "[sweep]") {
  const std::set<std::string> places = {
      "core/dynamics/method_options",   // its field
      "core/dynamics/method_settings",  // its row
      "core/dynamics/stepper_table",    // the steppers that read it
      "core/scene/scene_schema.json",   // its values and its steppers
      "docs/methods/scene_format.md",   // its row
  };
  for (const MethodSetting& setting : kMethodSettings) {
    std::set<std::string> others = places;
    for (const std::string& file : files_naming({setting.key})) others.erase(file);
    others.erase("core/dynamics/method_options");  // a field may have another name than its key
    CAPTURE(setting.key, others);
    CHECK(others.empty());
  }
  // Multigrid's use of this one is no place of another.
  std::set<std::string> named = files_naming({"carried_acceleration"});
  CHECK(named.erase("core/dynamics/position_based/stepper_position_based") == 1);
  CHECK(named.erase("docs/methods/multigrid.md") == 1);
  CHECK(named == places);
  tell_places("method_setting", named.size());
}

}  // namespace pleat::made_up_setting
