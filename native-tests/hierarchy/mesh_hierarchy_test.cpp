#include "core/hierarchy/mesh_hierarchy.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/files/obj_file.h"
#include "core/mesh/mesh_fault.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/meshes.h"
#include "native-tests/support/topology.h"

namespace pleat {
namespace {

MeshHierarchy hierarchy_of(const TriangleMesh& mesh, HierarchyOptions options = {}) {
  return mesh_hierarchy(mesh, {}, options);
}

/// Any linear function of places.
Positions linear_field(const Positions& x) {
  Mat3 A;
  A << 1, 2, -1, 0.5, -3, 2, 0, 1, 4;
  return (A * x).colwise() + Vec3(3, -1, 2);
}

TriangleMesh rolled_sheet(double radius) {
  TriangleMesh mesh = triangulated_sheet(Triangulation::alternating, 24, 24, 0.05);
  mesh.pattern = pattern_of(mesh);
  mesh.rest_positions = on_cylinder(mesh.rest_positions, 0, radius);
  return mesh;
}

}  // namespace

TEST_CASE("hierarchy: every level is a sound mesh of vertices of the finer one", "[multigrid]") {
  const auto pattern = GENERATE(from_range(kTriangulations));
  const double ratio = GENERATE(0.5, 0.25, 0.125);
  CAPTURE(static_cast<int>(pattern), ratio);
  const TriangleMesh mesh = triangulated_sheet(pattern, 24, 24, 0.1);
  HierarchyOptions options;
  options.ratio = ratio;
  options.n_coarser = 2;
  const MeshHierarchy hierarchy = hierarchy_of(mesh, options);
  REQUIRE(hierarchy.shortage.empty());
  REQUIRE(hierarchy.levels.size() == 3);
  CHECK(hierarchy.levels[0].n_vertices() == mesh.n_vertices());
  for (std::size_t k = 1; k < 3; ++k) {
    const MeshLevel& finer = hierarchy.levels[k - 1];
    const MeshLevel& level = hierarchy.levels[k];
    CHECK(level.n_vertices() == std::lround(ratio * finer.n_vertices()));
    CHECK(std::is_sorted(level.vertices.begin(), level.vertices.end()));
    CHECK(std::includes(finer.vertices.begin(), finer.vertices.end(), level.vertices.begin(),
                        level.vertices.end()));
    CHECK_FALSE(mesh_fault(positions_on(level, mesh.rest_positions), level.triangles, 0));
    CHECK(level.edges.size() == mesh_edges(level.triangles).size());
    CHECK(finer.from_coarser.n_rows() == finer.n_vertices());
  }
}

TEST_CASE("hierarchy: levels of a garment have its pieces, its borders and its holes",
          "[multigrid]") {
  const std::string name = GENERATE("skirt", "t_shirt");
  const ObjMesh obj = read_obj(repository_file("assets/meshes/" + name + ".obj"));
  TriangleMesh mesh;
  mesh.rest_positions = obj.positions;
  mesh.triangles = obj.triangles;
  HierarchyOptions options;
  options.ratio = 0.5;
  options.n_coarser = 4;
  const MeshHierarchy hierarchy = hierarchy_of(mesh, options);
  REQUIRE(hierarchy.shortage.empty());
  const Topology finest = topology(mesh.triangles, mesh.n_vertices());
  for (const MeshLevel& level : hierarchy.levels) {
    CAPTURE(name, level.n_vertices());
    CHECK_FALSE(mesh_fault(positions_on(level, mesh.rest_positions), level.triangles, 0));
    const Topology kept = topology(level.triangles, level.n_vertices());
    CHECK(kept.is_manifold);
    CHECK(kept.n_components == finest.n_components);
    CHECK(kept.n_border_loops == finest.n_border_loops);
    CHECK(kept.euler == finest.euler);
  }
}

TEST_CASE("hierarchy: of a sheet in space edges are as long as in its pattern, chords are not",
          "[multigrid]") {
  const TriangleMesh mesh = rolled_sheet(0.15);
  const TriangleMesh lying = triangulated_sheet(Triangulation::alternating, 24, 24, 0.05);
  double largest_gap = 0;
  for (const MeshLevel& level : hierarchy_of(mesh).levels)
    for (const LevelEdge& edge : level.edges) {
      const Vec3 along = lying.rest_positions.col(level.vertices[edge.a]) -
                         lying.rest_positions.col(level.vertices[edge.b]);
      CHECK(edge.geodesic == Approx(along.norm()).epsilon(1e-12));
      CHECK(edge.chord <= edge.geodesic * (1 + 1e-12));
      largest_gap = std::max(largest_gap, 1 - edge.chord / edge.geodesic);
    }
  CHECK(largest_gap > 0.004);
}

TEST_CASE("transfer: constants come exactly", "[multigrid]") {
  const auto weights =
      GENERATE(TransferWeights::inverse_distance, TransferWeights::moving_least_squares);
  const auto pattern = GENERATE(from_range(kTriangulations));
  HierarchyOptions options;
  options.weights = weights;
  const MeshHierarchy hierarchy = hierarchy_of(triangulated_sheet(pattern, 20, 20, 0.1), options);
  for (std::size_t k = 0; k + 1 < hierarchy.levels.size(); ++k) {
    const Positions ones = Positions::Constant(3, hierarchy.levels[k + 1].n_vertices(), 1);
    const Positions fine = hierarchy.levels[k].from_coarser * ones;
    CHECK((fine.array() - 1).abs().maxCoeff() < 1e-12);
  }
}

TEST_CASE("transfer: linear fields come exactly by least squares, roughly by distance",
          "[multigrid]") {
  const TriangleMesh mesh = triangulated_sheet(Triangulation::jittered, 20, 20, 0.1);
  const auto error = [&](TransferWeights weights) {
    HierarchyOptions options;
    options.weights = weights;
    const MeshHierarchy hierarchy = hierarchy_of(mesh, options);
    const Positions coarse = linear_field(positions_on(hierarchy.levels[1], mesh.rest_positions));
    const Positions fine = linear_field(mesh.rest_positions);
    const Transfer& transfer = hierarchy.levels[0].from_coarser;
    // Only vertices whose parents span a plane can come exactly.
    std::vector<double> errors;
    for (int v = 0; v < transfer.n_rows(); ++v)
      if (transfer.begin[static_cast<std::size_t>(v) + 1] -
              transfer.begin[static_cast<std::size_t>(v)] >=
          4)
        errors.push_back((transfer * coarse - fine).col(v).norm());
    REQUIRE(errors.size() > 50);
    return *std::max_element(errors.begin(), errors.end());
  };
  CHECK(error(TransferWeights::moving_least_squares) < 1e-12);
  CHECK(error(TransferWeights::inverse_distance) > 1e-3);
}

TEST_CASE("transfer: its linear error is how far places come from themselves", "[multigrid]") {
  // Parents at 0 and 3, the vertex at 1: weights 4/5 and 1/5 put it to 3/5.
  Positions places(3, 3);
  places << 0, 1, 3, 0, 0, 0, 0, 0, 0;
  const std::vector<VertexId> kept{VertexId(0), VertexId(2)};
  const std::vector<std::vector<VertexId>> neighbours{
      {VertexId(1)}, {VertexId(0), VertexId(2)}, {VertexId(1)}};
  Positions coarse(3, 2);
  coarse << places.col(0), places.col(2);
  const Transfer rough =
      transfer_between(kept, neighbours, places, TransferWeights::inverse_distance);
  CHECK(rough.terms[1].weight == Approx(0.8));
  CHECK(linear_error(rough, coarse, places) == Approx(0.4));
  const Transfer exact =
      transfer_between(kept, neighbours, places, TransferWeights::moving_least_squares);
  CHECK(linear_error(exact, coarse, places) == Approx(0).margin(1e-14));
}

TEST_CASE("transfer: fewer than two parents beside a vertex are looked for in further rings",
          "[multigrid]") {
  // A path of six vertices, of which the first and the last are kept.
  Positions places = Positions::Zero(3, 6);
  std::vector<std::vector<VertexId>> neighbours(6);
  for (int v = 0; v < 6; ++v) {
    places(0, v) = v;
    if (v > 0) neighbours[static_cast<std::size_t>(v)].push_back(VertexId(v - 1));
    if (v < 5) neighbours[static_cast<std::size_t>(v)].push_back(VertexId(v + 1));
  }
  const Transfer transfer = transfer_between({VertexId(0), VertexId(5)}, neighbours, places,
                                             TransferWeights::inverse_distance);
  for (const std::size_t v : {1u, 2u, 3u, 4u})
    CHECK(transfer.begin[v + 1] - transfer.begin[v] == 2);
  CHECK(transfer.begin[1] == 1);
}

TEST_CASE("transfer: a parent in the same place takes all the weight", "[multigrid]") {
  Positions places = Positions::Zero(3, 3);
  places(0, 2) = 1;
  const Transfer transfer = transfer_between(
      {VertexId(0), VertexId(2)}, {{VertexId(1)}, {VertexId(0), VertexId(2)}, {VertexId(1)}},
      places, GENERATE(TransferWeights::inverse_distance, TransferWeights::moving_least_squares));
  REQUIRE(transfer.begin[2] - transfer.begin[1] == 1);
  CHECK(transfer.terms[1].coarse == VertexId(0));
  CHECK(transfer.terms[1].weight == 1);
}

TEST_CASE("hierarchy: deeper than the mesh allows, it ends at the last level and says so",
          "[multigrid]") {
  HierarchyOptions options;
  options.n_coarser = 12;
  const MeshHierarchy hierarchy =
      hierarchy_of(triangulated_sheet(Triangulation::one_way, 8, 8, 0.1), options);
  CHECK(hierarchy.levels.size() == 5);  // 81, 41, 21, 11 and 6 vertices; 3 are fewer than corners
  CHECK_THAT(hierarchy.shortage, Catch::Contains("expected 12 coarser levels, got 4"));
}

TEST_CASE("hierarchy: ratios and depths beyond their bounds are refused", "[multigrid]") {
  HierarchyOptions options;
  options.ratio = GENERATE(0.1, 0.9, -1.0, 2.0, std::numeric_limits<double>::quiet_NaN());
  CHECK_THROWS_AS(options.validate(), InputError);
  options = {};
  options.n_coarser = 0;
  CHECK_THROWS_AS(options.validate(), InputError);
}

TEST_CASE("hierarchy: the same mesh has the same levels", "[multigrid]") {
  const TriangleMesh mesh = triangulated_sheet(Triangulation::jittered, 20, 20, 0.1);
  const MeshHierarchy first = hierarchy_of(mesh), second = hierarchy_of(mesh);
  for (std::size_t k = 0; k < first.levels.size(); ++k) {
    CHECK(first.levels[k].vertices == second.levels[k].vertices);
    CHECK(first.levels[k].triangles == second.levels[k].triangles);
  }
}

}  // namespace pleat
