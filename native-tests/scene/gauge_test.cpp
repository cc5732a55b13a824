#include "core/scene/gauge.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/scene/simulation.h"
#include "native-tests/support/meshes.h"
#include "native-tests/support/models.h"

using namespace pleat;

namespace {

void check_same(const std::vector<GaugeEdge>& a, const std::vector<GaugeEdge>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i].a == b[i].a);
    CHECK(a[i].b == b[i].b);
    CHECK(a[i].rest_length == b[i].rest_length);
  }
}

}  // namespace

TEST_CASE("gauge: a sheet is gauged by the edges of its springs along the threads, in their order",
          "[scene]") {
  QuadMesh mesh = sheet_with_aspect(3, 5, 1.3);
  mesh.refine_uniformly(GENERATE(0, 1, 2));
  check_same(gauge_edges(mesh), gauge_edges(sheet_model(mesh, soft_fabric()).springs));
}

TEST_CASE("gauge: springs against shear and without length gauge nothing", "[scene]") {
  const auto spring = [](double rest_length, SpringKind kind) {
    return Spring{VertexId(0), VertexId(1), 1, rest_length, 0, kind};
  };
  const std::vector<Spring> springs = {spring(0, SpringKind::other), spring(1, SpringKind::shear),
                                       spring(2, SpringKind::other), spring(3, SpringKind::warp),
                                       spring(0, SpringKind::weft)};
  const std::vector<GaugeEdge> gauge = gauge_edges(springs);
  REQUIRE(gauge.size() == 2);
  CHECK(gauge[0].rest_length == 2);
  CHECK(gauge[1].rest_length == 3);
}

TEST_CASE("gauge: a triangle mesh is gauged by each of its edges once", "[scene]") {
  const int cells = GENERATE(1, 4);
  const TriangleMesh mesh = square_sheet(cells).triangle_mesh();
  const std::vector<GaugeEdge> gauge = gauge_edges(mesh);
  const int n_straight = 2 * cells * (cells + 1);
  CHECK(static_cast<int>(gauge.size()) == n_straight + cells * cells);
  double sum = 0;
  for (const GaugeEdge& edge : gauge) sum += edge.rest_length;
  CHECK(sum == Approx((n_straight + std::sqrt(2.0) * cells * cells) / cells));
}

TEST_CASE("gauge: what a cloth is gauged by does not change with what it was before", "[scene]") {
  Scene old = released_sheet_scene(3, "leather");
  Scene fresh = released_sheet_scene(3, "chiffon");
  fresh.level = 1;
  Simulation before(old);
  before.step();
  Simulation after(fresh);
  const std::vector<GaugeEdge> own = after.gauge();
  after.carry_over(before);
  after.step();
  check_same(after.gauge(), own);
}
