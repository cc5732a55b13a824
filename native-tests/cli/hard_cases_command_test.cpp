#include <catch2/catch.hpp>
#include <filesystem>

#include "core/files/json_text.h"
#include "core/hard_cases/hard_case_table.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/pleat_command.h"

namespace pleat {
namespace {

const std::string kScenes = repository_path("assets/hard_cases");

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("hard-cases command: a table of cases by steppers, and what is asked", "[cli]") {
  const ScratchFolder folder;
  const Ending ending =
      pleat_command(folder, {"hard-cases", "--short", "--scenes", kScenes, "pin_named_twice",
                             "zero_length_springs", "weights_all_zero"});
  CHECK(ending.status == 0);
  CHECK(has(ending.out, "| case | implicit | imex |"));
  CHECK(has(ending.out,
            "| zero_length_springs | ok | ok | ok | ok | ok | ok | ok | ok | ok | ok | |"));
  CHECK(has(ending.out, "| pin_named_twice | refused [1] | refused [1] |"));
  CHECK(has(ending.out, "| weights_all_zero | | | | | | | | | | | refused [2] |"));
  CHECK(has(ending.out, "1. the input is bad: /pins/1: expected one motion for each vertex"));
  CHECK(has(ending.out, "21 outcomes, 0 unexpected"));
}

TEST_CASE("hard-cases command: files for people and machines, kept unless told otherwise",
          "[cli]") {
  const ScratchFolder folder;
  const std::string markdown = (folder / "cases.md").string();
  const std::string json = (folder / "cases.jsonl").string();
  const std::vector<std::string> words = {
      "hard-cases", "--short", "--stepper",  "rk4",    "--scenes",           kScenes,
      "--json",     json,      "--markdown", markdown, "zero_length_springs"};
  REQUIRE(pleat_command(folder, words).status == 0);
  CHECK(has(text_of(markdown), "`./pleat hard-cases --short --stepper rk4"));
  const Json outcome = parse_json(text_of(json));
  CHECK(outcome.at("case") == "zero_length_springs");
  CHECK(outcome.at("stepper") == "rk4");
  CHECK(outcome.at("status") == "ok");
  CHECK(outcome.at("expected") == true);
  CHECK(outcome.at("findings").size() == 2);
  CHECK(pleat_command(folder, words).status == 2);
}

TEST_CASE("hard-cases command: an outcome that is not as it should be is exit status 1", "[cli]") {
  const ScratchFolder folder;
  Json scene = parse_json(text_of(kScenes + "/zero_length_springs.json"));
  scene["cloth"]["particles"]["velocities_m_per_s"] =
      Json(16, Json{0, 100, 0});  // too fast for what it may reach
  write(folder / "zero_length_springs.json", scene.dump());
  const Ending ending =
      pleat_command(folder, {"hard-cases", "--short", "--stepper", "implicit", "--scenes",
                             folder.path().string(), "zero_length_springs"});
  CHECK(ending.status == 1);
  CHECK(has(ending.out, "**failed** [1]"));
  CHECK(has(ending.out, "distance from the origin [m]: expected at most 3, got"));
}

TEST_CASE("hard-cases command: unknown names and missing scenes are bad input", "[cli]") {
  const ScratchFolder folder;
  const Ending unknown = pleat_command(folder, {"hard-cases", "one_pint"});
  CHECK(unknown.status == 2);
  CHECK(has(unknown.error, "one_pint: unknown case; the cases are stiffness_ratio, "));
  const Ending stepper = pleat_command(folder, {"hard-cases", "--stepper", "euler"});
  CHECK(stepper.status == 2);
  CHECK(has(stepper.error, "--stepper: expected one of implicit, imex"));
  const Ending missing =
      pleat_command(folder, {"hard-cases", "one_point", "--scenes", folder.path().string()});
  CHECK(missing.status == 2);
  CHECK(has(missing.error, "one_point.json"));
}

TEST_CASE("hard-cases command: the table in docs has every case", "[cli]") {
  const std::string table = repository_file("docs/hard-cases-table.md");
  for (const HardCase& hard_case : hard_cases()) {
    CAPTURE(hard_case.name);
    CHECK(has(table, "| " + hard_case.name + " |"));
  }
}

}  // namespace pleat
