#include "core/model/stretch.h"

#include <catch2/catch.hpp>
#include <cmath>

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

QuadMesh refined_sheet(int cells, int level) {
  QuadMesh mesh = square_sheet(cells);
  mesh.refine_uniformly(level);
  return mesh;
}

}  // namespace

TEST_CASE(
    "stretch: a sheet is gauged by the edges of its springs along the threads, in their order",
    "[model]") {
  QuadMesh mesh = sheet_with_aspect(3, 5, 1.3);
  mesh.refine_uniformly(GENERATE(0, 1, 2));
  check_same(gauge_edges(mesh), gauge_edges(sheet_model(mesh, soft_fabric()).springs));
}

TEST_CASE("stretch: springs against shear, of bending and without length gauge nothing",
          "[model]") {
  const auto spring = [](double rest_length, SpringKind kind) {
    return Spring{VertexId(0), VertexId(1), 1, rest_length, 0, kind};
  };
  const std::vector<Spring> springs = {spring(0, SpringKind::other), spring(1, SpringKind::shear),
                                       spring(2, SpringKind::other), spring(3, SpringKind::warp),
                                       spring(0, SpringKind::weft),  spring(4, SpringKind::bend)};
  const std::vector<GaugeEdge> gauge = gauge_edges(springs);
  REQUIRE(gauge.size() == 2);
  CHECK(gauge[0].rest_length == 2);
  CHECK(gauge[1].rest_length == 3);
}

TEST_CASE("stretch: a triangle mesh is gauged by each of its edges once", "[model]") {
  const int cells = GENERATE(1, 4);
  const TriangleMesh mesh = square_sheet(cells).triangle_mesh();
  const std::vector<GaugeEdge> gauge = gauge_edges(mesh);
  const int n_straight = 2 * cells * (cells + 1);
  CHECK(static_cast<int>(gauge.size()) == n_straight + cells * cells);
  double sum = 0;
  for (const GaugeEdge& edge : gauge) sum += edge.rest_length;
  CHECK(sum == Approx((n_straight + std::sqrt(2.0) * cells * cells) / cells));
}

TEST_CASE("stretch: uniform extension is the strain of every gauge edge", "[model]") {
  const double strain = GENERATE(0.02, -0.03, 0.0);
  const QuadMesh mesh = refined_sheet(3, 1);
  const std::vector<GaugeEdge> gauge =
      GENERATE(true, false) ? gauge_edges(mesh) : gauge_edges(mesh.triangle_mesh());
  const Positions stretched = (1 + strain) * mesh.rest_positions();
  const Stretch found = stretch(gauge, stretched);
  const double expected = std::abs(strain);
  CHECK(found.rms == Approx(expected).epsilon(1e-10).margin(1e-14));
  CHECK(found.largest == Approx(expected).epsilon(1e-10).margin(1e-14));
  StrainMap map(gauge, mesh.n_vertices());
  for (const float value : map.update(stretched))
    CHECK(value == Approx(strain).epsilon(1e-6).margin(1e-7));
}

// Half of a square sheet's gauge edges run along warp, so the RMS is the strain over sqrt(2).
TEST_CASE("stretch: a sheet is gauged along its threads alone", "[model]") {
  const QuadMesh mesh = square_sheet(4);
  Positions along_warp = mesh.rest_positions();
  along_warp.row(1) *= 1.01;  // warp runs down
  const Stretch found = stretch(gauge_edges(mesh), along_warp);
  CHECK(found.largest == Approx(0.01).epsilon(1e-10));
  CHECK(found.rms == Approx(0.01 / std::sqrt(2.0)).epsilon(1e-10));
}

TEST_CASE("stretch: cloth without a gauge is not stretched", "[model]") {
  const Positions positions = Positions::Random(3, 2);
  CHECK(stretch({}, positions).largest == 0);
  CHECK(stretch({}, positions).rms == 0);
}
