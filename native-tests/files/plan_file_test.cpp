#include "core/files/plan_file.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/base/random.h"
#include "core/files/json_text.h"
#include "native-tests/support/bent_sheets.h"

namespace pleat {
namespace {

RefinementPlan plan_of_two_examples(const PlanOptions& options) {
  const QuadMesh base = lying_sheet(6);
  QuadMesh fine = base;
  fine.refine_uniformly(2);
  Random random(2);
  const auto example = [&](double u0) {
    return example_by_rule(fine, [&](double u, double v) {
      const double bend = 20 * std::exp(-10 * (u - u0) * (u - u0)) + random.uniform(0, 1);
      return Eigen::Vector2d(bend, bend / (3 + v));
    });
  };
  std::array examples{example(0.2), example(0.9)};
  for (std::size_t e = 0; e < 2; ++e) {
    FaceLossSum losses(fine);
    losses.add(folded(fine, 0.2 + 0.7 * static_cast<double>(e), 1.2));
    examples[e].losses = losses.losses();
  }
  examples[0].name = "walk \"1\"";
  examples[1].name = "squat";
  RefinementPlan plan = refinement_plan(base, fine, examples, options);
  plan.curvature_limits = {1.0 / 3, 7.1, 30};
  plan.splits[1].for_balance = true;
  return plan;
}

PlanOptions budget(PlanOptions options, int max_vertices) {
  options.max_vertices = max_vertices;
  return options;
}

/// The pointer at which a text is refused that has one value replaced.
std::string refused_at(const std::string& pointer, const Json& value,
                       const PlanOptions& options = by_curvature()) {
  Json document = parse_json(plan_text(plan_of_two_examples(options)));
  document[Json::json_pointer(pointer)] = value;
  try {
    read_plan(document.dump());
    return "nowhere";
  } catch (const InputError& error) {
    return error.where();
  }
}

}  // namespace

TEST_CASE("plan file: a plan is read back to the bit", "[files]") {
  const PlanOptions options =
      GENERATE(PlanOptions{}, budget({}, 120), by_curvature(), budget(by_curvature(), 120));
  const RefinementPlan plan = plan_of_two_examples(options);
  const RefinementPlan again = read_plan(plan_text(plan));
  REQUIRE(again.examples.size() == 2);
  for (std::size_t e = 0; e < 2; ++e) {
    CHECK(again.examples[e].name == plan.examples[e].name);
    CHECK(again.examples[e].centres == plan.examples[e].centres);
    CHECK(again.examples[e].low == plan.examples[e].low);
    CHECK(again.examples[e].high == plan.examples[e].high);
  }
  CHECK(again.n_patterns == plan.n_patterns);
  CHECK(again.patterns == plan.patterns);
  CHECK(again.options.criterion == plan.options.criterion);
  CHECK(again.options.largest_loss == plan.options.largest_loss);
  CHECK(again.options.demand == plan.options.demand);
  CHECK(again.options.max_vertices == plan.options.max_vertices);
  CHECK(again.options.level_cap == plan.options.level_cap);
  CHECK(again.n_vertices == plan.n_vertices);
  CHECK(again.base_mesh == plan.base_mesh);
  CHECK(again.curvature_limits == plan.curvature_limits);
  REQUIRE(again.splits.size() == plan.splits.size());
  REQUIRE(plan.splits.size() > 5);
  for (std::size_t s = 0; s < plan.splits.size(); ++s) {
    CHECK(again.splits[s].face == plan.splits[s].face);
    CHECK(again.splits[s].demand == plan.splits[s].demand);
    CHECK(again.splits[s].for_balance == plan.splits[s].for_balance);
  }
  CHECK(plan_text(again) == plan_text(plan));
  CHECK(planned_mesh(lying_sheet(6), again).n_vertices() == plan.n_vertices);
}

TEST_CASE("plan file: one that names no criterion is of curvature", "[files]") {
  Json document = parse_json(plan_text(plan_of_two_examples(by_curvature())));
  document.erase("criterion");
  const RefinementPlan plan = read_plan(document.dump());
  CHECK(plan.options.criterion == PlanCriterion::curvature);
  CHECK(plan.options.demand == 3);
}

TEST_CASE("plan file: what is no plan is refused with its place", "[files]") {
  CHECK(refused_at("/format", "pleat plan 1") == "nowhere");
  CHECK(refused_at("/format", "pleat frames 1") == "/format");
  CHECK(refused_at("/patterns", 0) == "/patterns");
  CHECK(refused_at("/patterns", 2) == "/examples/0/centres_per_m");
  CHECK(refused_at("/base_mesh/fingerprint", "12G") == "/base_mesh/fingerprint");
  CHECK_THAT(refused_at("/base_mesh/vertices", 48), Catch::StartsWith("/patterns_of_vertices/"));
  CHECK(refused_at("/base_mesh/vertices", 50) == "/patterns_of_vertices");
  CHECK(refused_at("/patterns_of_vertices/0/0", 3) == "/patterns_of_vertices/0/0");
  CHECK(refused_at("/patterns_of_vertices/0/1", 50) == "/patterns_of_vertices/0/1");
  CHECK(refused_at("/detail_demand", 8) == "/detail_demand");
  CHECK(refused_at("/vertex_budget", 80).empty());  // the plan as a whole: it has a demand
  CHECK(refused_at("/criterion", "curve") == "/criterion");
  CHECK(refused_at("/criterion", "shape").empty());  // the plan as a whole: its demand is no length
  CHECK(refused_at("/largest_loss_m", 0.1, {}) == "nowhere");
  CHECK(refused_at("/largest_loss_m", 3, {}) == "/largest_loss_m");
  CHECK(refused_at("/largest_loss_m", -0.001, {}) == "/largest_loss_m");
  CHECK(refused_at("/level_cap", 9) == "/level_cap");
  CHECK(refused_at("/examples/1/low_per_m/0", "x") == "/examples/1/low_per_m/0");
  CHECK(refused_at("/curvature_limits_per_m/1", -1) == "/curvature_limits_per_m/1");
  CHECK(refused_at("/splits/0", Json::array({1})) == "/splits/0");
  CHECK(refused_at("/splits/0", Json::array({1, 2, "because"})) == "/splits/0/2");
  CHECK(refused_at("/splits/0/0", -1) == "/splits/0/0");
}

}  // namespace pleat
