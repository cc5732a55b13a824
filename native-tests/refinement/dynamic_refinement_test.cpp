#include "core/refinement/dynamic_refinement.h"

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "core/base/check.h"
#include "core/base/random.h"
#include "core/refinement/mesh_match.h"
#include "native-tests/support/bent_sheets.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

/// Linear momentum per areal density [m^3/s].
Vec3 momentum(const GradedState& state) { return state.velocities * state.mesh.vertex_areas(); }

Positions random_columns(Eigen::Index n, Random& random) {
  Positions columns(3, n);
  for (Eigen::Index v = 0; v < n; ++v)
    columns.col(v) << random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1);
  return columns;
}

GradedState random_state(const QuadMesh& mesh, Random& random) {
  GradedState state{mesh, shaken(mesh.rest_positions(), 0.02, random),
                    random_columns(mesh.n_vertices(), random)};
  straighten(mesh.hanging_vertices(), state.positions);
  straighten(mesh.hanging_vertices(), state.velocities);
  return state;
}

void check_balance(const GradedState& state) {
  std::set<int> hanging;
  for (const HangingVertex& h : state.mesh.hanging_vertices()) {
    hanging.insert(h.vertex);
    for (const Positions* columns : {&state.positions, &state.velocities}) {
      const Vec3 middle = (columns->col(h.parents[0]) + columns->col(h.parents[1])) / 2;
      CHECK((columns->col(h.vertex) - middle).norm() < 1e-14);
    }
  }
  for (const HangingVertex& h : state.mesh.hanging_vertices())
    for (const VertexId parent : h.parents) CHECK(hanging.count(parent) == 0);
}

/// Positions by place in the rest shape, in units that separate all vertices.
std::map<std::pair<long, long>, Vec3> by_place(const GradedState& state) {
  std::map<std::pair<long, long>, Vec3> places;
  for (int v = 0; v < state.mesh.n_vertices(); ++v) {
    const auto uv = state.mesh.rest_coordinates().col(v);
    places[{std::lround(uv[0] * 1e6), std::lround(uv[1] * 1e6)}] = state.positions.col(v);
  }
  return places;
}

/// The largest way between two states of a material point that both have [m].
double largest_jump(const GradedState& a, const GradedState& b) {
  const auto places = by_place(a);
  double largest = 0;
  for (const auto& [place, x] : by_place(b))
    if (const auto before = places.find(place); before != places.end())
      largest = std::max(largest, (before->second - x).norm());
  return largest;
}

}  // namespace

TEST_CASE("dynamic refinement: splitting and merging keep momentum and balance", "[refinement]") {
  const int seed = GENERATE(1, 2, 3, 4);
  CAPTURE(seed);
  Random random(static_cast<std::uint64_t>(seed));
  const QuadMesh base = lying_sheet(6);
  GradedState state = random_state(base, random);
  int n_split = 0;
  int n_merged = 0;
  for (int frame = 0; frame < 12; ++frame) {
    const Vec3 before = momentum(state);
    // A wave of random size runs over the cloth, so that groups merge behind it.
    state.positions = folded(state.mesh, random.uniform(0, 1), 1.2);
    straighten(state.mesh.hanging_vertices(), state.positions);
    DynamicRefinement::Result result =
        DynamicRefinement(base, {random.uniform(1, 4), 3}).adapted(std::move(state));
    state = std::move(result.state);
    n_split += result.n_split;
    n_merged += result.n_merged;
    CHECK((momentum(state) - before).norm() < 1e-13);
    CHECK(state.positions.allFinite());
    CHECK(state.velocities.allFinite());
    CHECK(state.velocities.cwiseAbs().maxCoeff() <= 1);
    check_balance(state);
  }
  CHECK(n_split > 20);
  CHECK(n_merged > 5);
}

TEST_CASE("dynamic refinement: faces are split where they bend and merged where they do not",
          "[refinement]") {
  const QuadMesh base = lying_sheet(16);
  const DynamicRefinement refinement(base, {3, 2});
  const auto rolled = [&](const QuadMesh& mesh, double place) {
    GradedState state{mesh, folded(mesh, place, 1), Positions::Zero(3, mesh.n_vertices())};
    straighten(mesh.hanging_vertices(), state.positions);
    return state;
  };
  const GradedState once = refinement.adapted(rolled(base, 0.3)).state;
  for (const QuadFace& face : once.mesh.faces()) {
    const double u = once.mesh.rest_coordinates().col(face.corners[0])[0];
    if (face.level == 1) CHECK(std::abs(u - 0.3) < 0.4);
    CHECK(face.level <= 1);
  }
  CHECK(once.mesh.n_vertices() > base.n_vertices());
  // The fold has gone elsewhere: after a few frames nothing is left of its first place.
  GradedState state = once;
  for (int frame = 0; frame < 4; ++frame) state = refinement.adapted(rolled(state.mesh, 0.8)).state;
  int n_there = 0;
  for (const QuadFace& face : state.mesh.faces()) {
    const double u = state.mesh.rest_coordinates().col(face.corners[0])[0];
    if (face.level > 0 && u < 0.3) ++n_there;
  }
  CHECK(n_there == 0);
  CHECK(state.mesh.faces().size() > base.faces().size());
}

TEST_CASE("dynamic refinement: between half of the threshold and all of it nothing changes",
          "[refinement]") {
  // The mean of the chords on a cylinder of 0.5 m radius is 0.8 to 1.2 / m, at borders too.
  const QuadMesh base = lying_sheet(10);
  QuadMesh mesh = base;
  mesh.refine_uniformly(1);
  const GradedState state{mesh, on_cylinder(mesh.rest_positions(), 0, 0.5),
                          Positions::Zero(3, mesh.n_vertices())};
  const auto changes = [&](double threshold) {
    const DynamicRefinement::Result result = DynamicRefinement(base, {threshold, 2}).adapted(state);
    return std::pair(result.n_split, result.n_merged);
  };
  CHECK(changes(0.75) == std::pair(400, 0));
  CHECK(changes(1.5) == std::pair(0, 0));
  CHECK(changes(2.5) == std::pair(0, 100));
}

TEST_CASE("dynamic refinement: cycles on a resting sheet move no vertex by a millimetre",
          "[refinement]") {
  // A cylinder of 0.5 m radius, 5 cm cells: an edge's middle lies 0.6 mm above the straight line.
  const QuadMesh base = lying_sheet(20);
  constexpr double kRadius = 0.5;
  GradedState state{base, on_cylinder(base.rest_positions(), 0, kRadius),
                    Positions::Zero(3, base.n_vertices())};
  const GradedState first = state;
  const DynamicRefinement finer(base, {0.3, 2});
  const DynamicRefinement coarser(base, {1.9, 2});
  for (int cycle = 0; cycle < 3; ++cycle) {
    for (const DynamicRefinement* refinement : {&finer, &coarser}) {
      GradedState fresh = refinement->adapted(state).state;
      CHECK(largest_jump(state, fresh) < 1e-3);
      CHECK(largest_jump(first, fresh) < 1e-3);
      CHECK(fresh.velocities.isZero(0));
      // It comes to rest on the cylinder again.
      state = std::move(fresh);
      state.positions = on_cylinder(state.mesh.rest_positions(), 0, kRadius);
      straighten(state.mesh.hanging_vertices(), state.positions);
    }
  }
  CHECK(by_place(state).size() >= by_place(first).size());
}

TEST_CASE("dynamic refinement: a flat sheet refined by hand goes back to the base to the bit",
          "[refinement]") {
  const QuadMesh base = lying_sheet(5);
  Random random(8);
  QuadMesh mesh = base;
  mesh.refine(std::array{FaceId(7), FaceId(12), FaceId(26), FaceId(31)});
  REQUIRE(mesh.faces().size() > 25 + 12);
  GradedState state{mesh, mesh.rest_positions(), Positions::Zero(3, mesh.n_vertices())};
  const DynamicRefinement refinement(base, {5, 2});
  for (int frame = 0; frame < 2; ++frame) state = refinement.adapted(std::move(state)).state;
  CHECK(state.mesh.faces().size() == 25);
  CHECK(state.positions == base.rest_positions());
  const DynamicRefinement::Result still = refinement.adapted(state);
  CHECK(still.n_split == 0);
  CHECK(still.n_merged == 0);
  CHECK(still.state.positions == state.positions);
}

TEST_CASE("dynamic refinement: no face is finer than the finest level", "[refinement]") {
  const QuadMesh base = lying_sheet(6);
  const int max_level = GENERATE(0, 1, 2);
  CAPTURE(max_level);
  Random random(5);
  GradedState state = random_state(base, random);
  for (int frame = 0; frame < 4; ++frame)
    state = DynamicRefinement(base, {1e-3, max_level}).adapted(std::move(state)).state;
  int finest = 0;
  for (const QuadFace& face : state.mesh.faces()) finest = std::max(finest, face.level);
  CHECK(finest == max_level);
}

TEST_CASE("dynamic refinement: values out of range are named", "[refinement]") {
  const QuadMesh base = lying_sheet(2);
  CHECK_THROWS_WITH(DynamicRefinement(base, {0, 2}), Catch::Contains("got 0"));
  CHECK_THROWS_WITH(DynamicRefinement(base, {1, 9}), Catch::Contains("got 9"));
}

}  // namespace pleat
