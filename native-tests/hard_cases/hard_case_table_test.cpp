#include "core/hard_cases/hard_case_table.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <set>

#include "core/dynamics/stepper_table.h"
#include "core/hard_cases/case_run.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

CaseFiles shipped_files() {
  return {fabric_library(),
          [](const std::string& name) { return repository_file("assets/hard_cases/" + name); }};
}

void check(const CaseOutcome& outcome) {
  CAPTURE(outcome.case_name, outcome.stepper, name(outcome.status), outcome.sentence);
  CHECK(outcome.is_expected());
}

/// Its brief run, with every stepper.
void check_brief(const HardCase& hard_case) {
  if (hard_case.still) {
    check(do_case(hard_case, shipped_files()));
    return;
  }
  for (const StepperType* type : standard_steppers())
    check(run_case(hard_case, *type, CaseLength::brief, shipped_files()));
}

/// Take no time to speak of: sanitizers look at them.
const std::set<std::string> kQuick = {
    "one_point",        "zero_length_springs",     "pin_named_twice",
    "weights_all_zero", "kinds_of_alike_features", "modes_of_two_parts"};

}  // namespace

TEST_CASE("hard cases: each has a name of its own, a sentence, a length and something asked",
          "[hard_cases]") {
  std::set<std::string> names;
  for (const HardCase& hard_case : hard_cases()) {
    CAPTURE(hard_case.name);
    CHECK(names.insert(hard_case.name).second);
    CHECK_FALSE(hard_case.breaks.empty());
    if (hard_case.still) continue;
    CHECK(hard_case.seconds.brief > 0);
    CHECK(hard_case.seconds.brief <= hard_case.seconds.full);
    CHECK((hard_case.is_bad_input || !hard_case.checks.empty()));
  }
}

TEST_CASE("hard cases: exceptions, settings and stops name steppers and checks that there are",
          "[hard_cases]") {
  for (const HardCase& hard_case : hard_cases()) {
    CAPTURE(hard_case.name);
    std::set<std::string> checks;
    for (const CaseCheck& check : hard_case.checks) CHECK(checks.insert(check.what).second);
    for (const VariantCheck& check : hard_case.variant_checks)
      CHECK(checks.insert(check.what).second);
    const auto is_stepper = [](const std::string& stepper) {
      return find_stepper(standard_steppers(), stepper) != nullptr;
    };
    for (const CaseException& exception : hard_case.exceptions) {
      CAPTURE(exception.check);
      CHECK(is_stepper(exception.stepper));
      CHECK(checks.count(exception.check) == 1);
    }
    for (const StepperSetting& setting : hard_case.settings) CHECK(is_stepper(setting.stepper));
    for (const AllowedStop& stop : hard_case.stops)
      CHECK((stop.stepper == "explicit" || stop.stepper == "rk4"));
  }
}

TEST_CASE("hard cases: each scene in the folder is a case's", "[hard_cases]") {
  std::set<std::string> names;
  for (const HardCase& hard_case : hard_cases()) names.insert(hard_case.name);
  for (const auto& entry :
       std::filesystem::directory_iterator(repository_path("assets/hard_cases")))
    if (entry.path().extension() == ".json") {
      CAPTURE(entry.path().string());
      CHECK(names.count(entry.path().stem().string()) == 1);
    }
}

TEST_CASE("hard cases: the quick ones end as they should with every stepper", "[hard_cases]") {
  for (const HardCase& hard_case : hard_cases())
    if (kQuick.count(hard_case.name) > 0) check_brief(hard_case);
}

TEST_CASE("hard cases: all others end as they should with every stepper", "[hard_cases][long]") {
  for (const HardCase& hard_case : hard_cases())
    if (kQuick.count(hard_case.name) == 0) check_brief(hard_case);
}

}  // namespace pleat
