#include "core/hard_cases/case_run.h"

#include <array>
#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/dynamics/stepper_table.h"
#include "core/hard_cases/case_checks.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

/// Throws everything away by as much again in each step, or at once beyond all numbers.
template <bool is_at_once>
class WildStepper final : public Stepper {
 public:
  WildStepper(ClothModel& model, const MethodOptions& options) : Stepper(model, options, 1) {}
  void refresh() override {}

 private:
  SolveReport substep(State& state, double, double) override {
    state.positions *= is_at_once ? 1e200 : 2;
    return {};
  }
};

template <bool is_at_once>
StepperType wild_type(const char* name) {
  StepperType type = steppers::kImplicitEuler;
  type.name = name;
  type.make = [](ClothModel& model, const MethodOptions& options) -> std::unique_ptr<Stepper> {
    return std::make_unique<WildStepper<is_at_once>>(model, options);
  };
  return type;
}

const StepperType kGrowing = wild_type<false>("growing");
const StepperType kBursting = wild_type<true>("bursting");
const std::array<const StepperType*, 6> kTable = {&steppers::kImplicitEuler,
                                                  &steppers::kExplicitEuler,
                                                  &steppers::kXpbd,
                                                  &steppers::kImex,
                                                  &kGrowing,
                                                  &kBursting};

constexpr const char* kSheet = R"({
  "cloth": {"sheet": {"columns": 2, "rows": 2}},
  "pins": [{"part": "upper_edge"}],
  "method": {"step_s": 0.01}})";

/// Asks no file but for the one scene.
CaseFiles files_with(const std::string& scene) {
  const auto source = [scene](const std::string& name) {
    if (name != "sheet.json") throw InputError(name, "no such file");
    return scene;
  };
  return {fabric_library(), source, {.steppers = kTable}};
}

HardCase sheet_case() {
  return {
      .name = "sheet", .breaks = "Nothing.", .seconds = {0.05, 0.2}, .checks = {stays_within(2)}};
}

CaseOutcome outcome(const HardCase& hard_case, const StepperType& type,
                    const std::string& scene = kSheet) {
  return run_case(hard_case, type, CaseLength::brief, files_with(scene));
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("hard cases: a run that keeps its checks is ok, for its brief or its full time",
          "[hard_cases]") {
  const CaseOutcome brief = outcome(sheet_case(), steppers::kImplicitEuler);
  CHECK(brief.status == CaseStatus::ok);
  CHECK(brief.is_expected());
  CHECK(brief.reached == 0.05);
  CHECK_FALSE(brief.is_cut());
  REQUIRE(brief.findings.size() == 1);
  CHECK(brief.findings[0].found == Approx(std::sqrt(2.0)).epsilon(0.02));
  const CaseOutcome full =
      run_case(sheet_case(), steppers::kImplicitEuler, CaseLength::full, files_with(kSheet));
  CHECK(full.reached == 0.2);
}

TEST_CASE("hard cases: a stepper that blows up is failed and unexpected", "[hard_cases]") {
  const CaseOutcome wild = outcome(sheet_case(), kGrowing);
  CHECK(wild.status == CaseStatus::failed);
  CHECK_FALSE(wild.is_expected());
  CHECK(has(wild.sentence, "distance from the origin [m]: expected at most 2, got "));
}

TEST_CASE("hard cases: a run that the numbers end is stopped, and expected where a row says why",
          "[hard_cases]") {
  HardCase hard_case = sheet_case();
  const CaseOutcome unexpected = outcome(hard_case, kBursting);
  CHECK(unexpected.status == CaseStatus::stopped);
  CHECK_FALSE(unexpected.is_expected());
  CHECK(has(unexpected.sentence, "vertex"));
  CHECK(unexpected.reached < unexpected.asked);
  hard_case.stops = {{"bursting", "it bursts"}};
  CHECK(outcome(hard_case, kBursting).is_expected());
  CHECK(outcome(hard_case, kBursting).excuse == "it bursts");
}

TEST_CASE("hard cases: what works on springs alone may refuse a membrane, and nothing else may",
          "[hard_cases]") {
  Json scene = parse_json(kSheet);
  scene["model"]["elasticity"] = "membrane";
  const CaseOutcome springs = outcome(sheet_case(), steppers::kXpbd, scene.dump());
  CHECK(springs.status == CaseStatus::refused);
  CHECK(springs.is_expected());
  scene["model"]["elasticity"] = "rubber";
  const CaseOutcome bad = outcome(sheet_case(), steppers::kImplicitEuler, scene.dump());
  CHECK(bad.status == CaseStatus::refused);
  CHECK_FALSE(bad.is_expected());
  CHECK(has(bad.sentence, "/model/elasticity: expected one of"));
}

TEST_CASE("hard cases: explicit steps that cannot be small enough may be refused", "[hard_cases]") {
  Json scene = parse_json(kSheet);
  scene["fabric"] = {{"stretch_warp_n_per_m", 1e12}, {"areal_density_kg_per_m2", 1e-6}};
  const CaseOutcome stiff = outcome(sheet_case(), steppers::kExplicitEuler, scene.dump());
  CHECK(stiff.status == CaseStatus::refused);
  CHECK(stiff.is_expected());
}

TEST_CASE("hard cases: bad input has to be refused", "[hard_cases]") {
  HardCase hard_case = sheet_case();
  hard_case.is_bad_input = true;
  CHECK(outcome(hard_case, steppers::kImplicitEuler).status == CaseStatus::failed);
  Json scene = parse_json(kSheet);
  scene["pins"][0]["part"] = "middle";
  const CaseOutcome refused = outcome(hard_case, steppers::kImplicitEuler, scene.dump());
  CHECK(refused.status == CaseStatus::refused);
  CHECK(refused.is_expected());
}

TEST_CASE("hard cases: a check that a stepper is spared is not asked of it, but of others",
          "[hard_cases]") {
  HardCase hard_case = sheet_case();
  hard_case.exceptions = {{"growing", stays_within(2).what, "it grows"}};
  CHECK(outcome(hard_case, kGrowing).status == CaseStatus::ok);
  CHECK(outcome(hard_case, kGrowing).findings.empty());
  CHECK(outcome(hard_case, steppers::kImplicitEuler).findings.size() == 1);
  hard_case.exceptions[0].bound = 1e9;
  CHECK(outcome(hard_case, kGrowing).status == CaseStatus::ok);
  CHECK(outcome(hard_case, kGrowing).findings[0].bound == 1e9);
  hard_case.exceptions[0].bound = 3;
  CHECK(outcome(hard_case, kGrowing).status == CaseStatus::failed);
}

TEST_CASE("hard cases: what would take too much work is cut, and told so", "[hard_cases]") {
  HardCase hard_case = sheet_case();
  hard_case.seconds.brief = 1e6;
  hard_case.checks.push_back(rests(1, 1e-3));
  const CaseOutcome cut = outcome(hard_case, steppers::kImplicitEuler);
  CHECK(cut.status == CaseStatus::ok);
  CHECK(cut.is_cut());
  CHECK(cut.reached < 1e4);
  REQUIRE(cut.findings.size() == 1);  // checks of the whole run are not asked
  CHECK(cut.findings[0].what == stays_within(2).what);
}

TEST_CASE("hard cases: variants run beside each other, and their ends are compared",
          "[hard_cases]") {
  HardCase hard_case = sheet_case();
  hard_case.variants = {{"light", {}}, {"heavy", {{"/fabric/areal_density_kg_per_m2", 10}}}};
  hard_case.variant_checks = {sags_agree(0.1)};
  const CaseOutcome compared = outcome(hard_case, steppers::kImplicitEuler);
  CHECK(compared.status == CaseStatus::failed);
  REQUIRE(compared.findings.size() == 3);
  CHECK(compared.findings[0].what == "light: distance from the origin [m]");
  CHECK(compared.findings[1].what == "heavy: distance from the origin [m]");
  CHECK(compared.findings[2].found > 1);
}

TEST_CASE("hard cases: a hand, another mesh and places to start from act when they are said to",
          "[hard_cases]") {
  HardCase hard_case = sheet_case();
  const auto found = [&] { return outcome(hard_case, steppers::kImplicitEuler).findings[0].found; };
  hard_case.checks = {velocity_jumps_at_most(0.5)};
  const double untouched = found();
  const VertexId lower_right(8);
  hard_case.events = {{0.02, HandGrabs{lower_right}}, {0.03, HandMoves{{0, 0.5, 0.5}}}};
  CHECK(found() > 2 * untouched);
  hard_case.checks = {stays_within(1.9)};
  hard_case.events = {{0.02, SceneSwitch{{{"/refinement/level", 1}}}}};
  CHECK(outcome(hard_case, steppers::kImplicitEuler).status == CaseStatus::ok);
  hard_case.events = {};
  hard_case.start = [](const Positions& rest) { return Positions(3 * rest); };
  CHECK(outcome(hard_case, steppers::kImplicitEuler).findings[0].found ==
        Approx(3 * std::sqrt(2.0)).epsilon(0.02));
}

TEST_CASE("hard cases: the same run has the same outcome to the bit", "[hard_cases]") {
  const HardCase hard_case = sheet_case();
  const double first = outcome(hard_case, steppers::kXpbd).findings[0].found;
  CHECK(outcome(hard_case, steppers::kXpbd).findings[0].found == first);
}

}  // namespace pleat
