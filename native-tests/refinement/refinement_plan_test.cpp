#include "core/refinement/refinement_plan.h"

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "core/base/check.h"
#include "core/base/random.h"
#include "core/refinement/mesh_match.h"
#include "native-tests/support/bent_sheets.h"

namespace pleat {
namespace {

QuadMesh fine_sheet(int cells, int levels) {
  QuadMesh fine = lying_sheet(cells);
  fine.refine_uniformly(levels);
  return fine;
}

RefinementPlan plan_of_patterns(int cells, const std::vector<int>& patterns,
                                const PlanOptions& options, int levels = 2, int n_patterns = 3) {
  const QuadMesh fine = fine_sheet(cells, levels);
  const BendExample example = example_of_patterns(fine, patterns, n_patterns);
  return refinement_plan(lying_sheet(cells), fine, {&example, 1}, options);
}

std::vector<int> random_patterns(int cells, int n_patterns, Random& random) {
  std::vector<int> patterns(static_cast<std::size_t>((cells + 1) * (cells + 1)), 0);
  for (int& pattern : patterns)
    if (random.below(3) == 0) pattern = static_cast<int>(random.below(n_patterns));
  return patterns;
}

/// Random features, smooth enough to cluster.
BendExample random_example(const QuadMesh& fine, Random& random) {
  const Vec3 at(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0.05, 0.5));
  return example_by_rule(fine, [&](double u, double v) {
    const double near = std::exp(-(std::pow(u - at.x(), 2) + std::pow(v - at.y(), 2)) / at.z());
    return Eigen::Vector2d(30 * near + random.uniform(0, 3), 5 * near);
  });
}

/// The budget's rule without any bookkeeping: of all active faces the most urgent that fits.
std::vector<int> greedy_splits(const QuadMesh& base, const QuadMesh& fine,
                               const BendExample& example, int max_vertices) {
  QuadMesh mesh = base;
  std::vector<int> splits;
  Eigen::RowVectorXd patterns(base.n_vertices());
  for (int v = 0; v < base.n_vertices(); ++v) patterns[v] = example.patterns.of_vertices[v];
  for (;;) {
    const Eigen::RowVectorXd demands = continued(patterns, mesh);
    const std::vector<FaceId> matching = matching_faces(mesh, fine);
    std::map<std::tuple<double, double, int>, QuadMesh> refinements;
    for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
      const QuadFace& face = mesh.faces()[f];
      if (!face.active() || face.level >= 2) continue;
      double excess = 0;
      for (const VertexId v : face.corners) excess += std::max(demands[v] - face.level, 0.0);
      std::set<int> covered;
      std::vector<FaceId> open{matching[f]};
      while (!open.empty()) {
        const QuadFace& piece = fine.faces()[open.back()];
        open.pop_back();
        if (piece.active())
          covered.insert(piece.corners.begin(), piece.corners.end());
        else
          open.insert(open.end(), piece.children.begin(), piece.children.end());
      }
      double curvature = 0;
      for (const int v : covered) curvature += example.features(0, v);
      curvature /= static_cast<double>(covered.size());
      QuadMesh refined = mesh;
      refined.refine(std::array{FaceId(static_cast<std::int64_t>(f))});
      if (refined.n_vertices() <= max_vertices)
        refinements.emplace(std::tuple(-excess, -curvature, static_cast<int>(f)),
                            std::move(refined));
    }
    if (refinements.empty()) return splits;
    const std::size_t n_before = mesh.faces().size();
    mesh = refinements.begin()->second;
    for (std::size_t f = n_before; f < mesh.faces().size(); f += 4)
      splits.push_back(mesh.faces()[f].parent);
  }
}

}  // namespace

TEST_CASE("plan: demands are corrected before new vertices take their mean", "[refinement]") {
  // One corner of the sheet with pattern 2: its face sums to 2. Then it has 1, the middles beside
  // it 1/2 and the centre 1/4: 2.25 for the child at the corner, 0.75 for those beside it.
  std::vector<int> patterns(25, 0);
  patterns[0] = 2;
  PlanOptions options = by_curvature();
  options.demand = 1;
  const RefinementPlan plan = plan_of_patterns(4, patterns, options);
  REQUIRE(plan.splits.size() == 2);
  CHECK(plan.splits[0].face == 0);
  CHECK(plan.splits[0].demand == 2);
  CHECK(plan.splits[1].face == 16);
  CHECK(plan.splits[1].demand == 2.25);
  CHECK(plan.n_vertices == 25 + 5 + 5);
  options.demand = 0.7;
  const RefinementPlan more = plan_of_patterns(4, patterns, options);
  const auto n_wanted = std::count_if(more.splits.begin(), more.splits.end(),
                                      [](const PlannedSplit& split) { return !split.for_balance; });
  CHECK(n_wanted == 4);
  CHECK(more.splits.size() == 6);  // the children beside the corner touch coarse faces
  options.demand = 2;
  CHECK(plan_of_patterns(4, patterns, options).splits.empty());
}

TEST_CASE("plan: a cloth bent most everywhere becomes the fine mesh", "[refinement]") {
  const std::vector<int> patterns(16, 2);
  PlanOptions options = by_curvature();
  options.demand = 0;
  CHECK(plan_of_patterns(3, patterns, options).n_vertices == 13 * 13);
  options.demand = 4;  // 4 corners of 2 exceed it, of 1 do not
  CHECK(plan_of_patterns(3, patterns, options).n_vertices == 7 * 7);
  options.demand = 0;
  options.level_cap = 1;
  CHECK(plan_of_patterns(3, patterns, options).n_vertices == 7 * 7);
  CHECK(plan_of_patterns(3, std::vector<int>(16, 0), options).n_vertices == 4 * 4);
}

TEST_CASE("plan: less demand, more vertices", "[refinement]") {
  Random random(3);
  const std::vector<int> patterns = random_patterns(8, 3, random);
  int last = 33 * 33 + 1;
  for (const double demand : {0.0, 1.0, 2.0, 3.0, 5.0, 7.5}) {
    PlanOptions options = by_curvature();
    options.demand = demand;
    const int n = plan_of_patterns(8, patterns, options).n_vertices;
    CHECK(n <= last);
    last = n;
  }
  CHECK(last < 120);
}

TEST_CASE("plan: its splits make its mesh, and each says why", "[refinement]") {
  const int seed = GENERATE(1, 2, 3, 4, 5);
  CAPTURE(seed);
  Random random(static_cast<std::uint64_t>(seed));
  const std::vector<int> patterns = random_patterns(7, 4, random);
  PlanOptions options = by_curvature();
  options.demand = 2.2;
  const RefinementPlan plan = plan_of_patterns(7, patterns, options, 3, 4);
  const QuadMesh mesh = planned_mesh(lying_sheet(7), plan);
  CHECK(mesh.n_vertices() == plan.n_vertices);
  CHECK(mesh.faces().size() == 49 + 4 * plan.splits.size());
  std::set<int> hanging;
  for (const HangingVertex& h : mesh.hanging_vertices()) hanging.insert(h.vertex);
  for (const HangingVertex& h : mesh.hanging_vertices())
    for (const VertexId parent : h.parents) CHECK(hanging.count(parent) == 0);
  int n_for_balance = 0;
  for (const PlannedSplit& split : plan.splits) {
    CHECK(split.for_balance == (split.demand <= options.demand));
    n_for_balance += int{split.for_balance};
  }
  if (seed == 1) CHECK(n_for_balance > 0);
}

TEST_CASE("plan: a vertex budget is never exceeded and nearly used up", "[refinement]") {
  const int budget = GENERATE(150, 200, 333, 500, 777, 1000);
  const int seed = GENERATE(1, 2, 3);
  CAPTURE(budget, seed);
  Random random(static_cast<std::uint64_t>(seed));
  const QuadMesh base = lying_sheet(8);
  const QuadMesh fine = fine_sheet(8, 2);
  const BendExample example = random_example(fine, random);
  PlanOptions options = by_curvature();
  options.max_vertices = budget;
  const RefinementPlan plan = refinement_plan(base, fine, {&example, 1}, options);
  CHECK(plan.n_vertices <= budget);
  CHECK(plan.n_vertices >= 0.97 * budget);
  CHECK(planned_mesh(base, plan).n_vertices() == plan.n_vertices);
}

TEST_CASE("plan: a vertex budget goes to the most urgent face that fits", "[refinement]") {
  const int budget = GENERATE(range(16, 60));
  const int seed = GENERATE(4, 5);
  CAPTURE(budget, seed);
  Random random(static_cast<std::uint64_t>(seed));
  const QuadMesh base = lying_sheet(3);
  const QuadMesh fine = fine_sheet(3, 2);
  // The second time all curvature is the same, so that the order of the faces decides.
  const BendExample example = seed == 4 ? random_example(fine, random)
                                        : example_of_patterns(fine, random_patterns(3, 3, random));
  PlanOptions options = by_curvature();
  options.max_vertices = budget;
  std::vector<int> splits;
  for (const PlannedSplit& split : refinement_plan(base, fine, {&example, 1}, options).splits)
    splits.push_back(split.face);
  CHECK(splits == greedy_splits(base, fine, example, budget));
}

TEST_CASE("plan: a budget beyond the fine mesh gives the fine mesh", "[refinement]") {
  PlanOptions options = by_curvature();
  options.max_vertices = 100000;
  CHECK(plan_of_patterns(3, std::vector<int>(16, 0), options).n_vertices == 13 * 13);
  options.max_vertices = 16;
  CHECK(plan_of_patterns(3, std::vector<int>(16, 2), options).splits.empty());
}

TEST_CASE("plan: of several examples the most bent counts", "[refinement]") {
  const QuadMesh base = lying_sheet(3);
  const QuadMesh fine = fine_sheet(3, 2);
  std::vector<int> left(16, 0);
  std::vector<int> right(16, 1);
  left[0] = left[5] = 2;
  right[5] = 0;
  const std::array examples{example_of_patterns(fine, left), example_of_patterns(fine, right)};
  const RefinementPlan plan = refinement_plan(base, fine, examples, by_curvature());
  std::vector<int> both(16, 1);
  both[0] = both[5] = 2;
  CHECK(plan.patterns == both);
  CHECK(plan.examples.size() == 2);
  CHECK(plan.examples[1].centres == examples[1].patterns.centres);
}

TEST_CASE("plan: values out of range are named", "[refinement]") {
  const std::vector<int> patterns(16, 1);
  const auto refusal = [&](const PlanOptions& options) -> std::string {
    try {
      plan_of_patterns(3, patterns, options);
      return "none";
    } catch (const InputError& error) {
      return error.where() + ": " + error.sentence();
    }
  };
  PlanOptions options = by_curvature();
  options.demand = 8;
  CHECK(refusal(options) == "detail demand: expected a number from 0 to below 8, got 8");
  options.demand = -0.5;
  CHECK(refusal(options) == "detail demand: expected a number from 0 to below 8, got -0.5");
  options.demand = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal(options) == "detail demand: expected a number from 0 to below 8, got nan");
  options = by_curvature();
  options.max_vertices = 15;
  CHECK(refusal(options) == "vertex budget: expected at least the base mesh's 16, got 15");
  options = by_curvature();
  options.level_cap = 3;
  CHECK(refusal(options) ==
        "level cap: expected a whole number from 0 to the fine mesh's level, 2, got 3");
}

TEST_CASE("plan: another mesh or spoilt splits are refused", "[refinement]") {
  PlanOptions options = by_curvature();
  options.demand = 1;
  RefinementPlan plan = plan_of_patterns(4, std::vector<int>(25, 2), options);
  CHECK_NOTHROW(planned_mesh(lying_sheet(4), plan));
  CHECK_THROWS_WITH(planned_mesh(lying_sheet(5), plan), Catch::Contains("another"));
  RefinementPlan spoilt = plan;
  spoilt.splits[3].face = FaceId(100000);
  CHECK_THROWS_AS(planned_mesh(lying_sheet(4), spoilt), InputError);
  spoilt = plan;
  spoilt.splits[3].face = spoilt.splits[2].face;
  CHECK_THROWS_AS(planned_mesh(lying_sheet(4), spoilt), InputError);
  spoilt = plan;
  spoilt.splits.pop_back();
  CHECK_THROWS_AS(planned_mesh(lying_sheet(4), spoilt), InputError);
}

}  // namespace pleat
