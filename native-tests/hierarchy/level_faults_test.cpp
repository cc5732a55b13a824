#include "core/hierarchy/level_faults.h"

#include <catch2/catch.hpp>

#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

/// A sheet of 3 x 3 vertices, 1 m apart, in the plane z = 0.
TriangleMesh small_sheet() { return triangulated_sheet(Triangulation::one_way, 2, 2, 1); }

/// A level of vertices of that sheet, by their places (x, y) there.
MeshLevel level_of(const TriangleMesh& mesh, const std::vector<Vec3>& places,
                   const std::vector<std::array<int, 3>>& triangles) {
  MeshLevel level;
  for (const Vec3& place : places)
    for (int v = 0; v < mesh.n_vertices(); ++v)
      if ((mesh.rest_positions.col(v) - place).norm() < 1e-9) level.vertices.emplace_back(v);
  REQUIRE(level.vertices.size() == places.size());
  for (const auto& [a, b, c] : triangles)
    level.triangles.push_back({VertexId(a), VertexId(b), VertexId(c)});
  return level;
}

}  // namespace

TEST_CASE("level faults: a sheet's two halves are as it is", "[multigrid]") {
  const TriangleMesh mesh = small_sheet();
  const MeshLevel level =
      level_of(mesh, {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const LevelFaults faults = level_faults(level, mesh);
  CHECK(faults.turned_triangles == 0);
  CHECK(faults.strayed_borders == 0);
  CHECK(faults.crowded_edges == 0);
  CHECK(faults.covered_share == Approx(1));
}

TEST_CASE("level faults: what is turned over counts and takes its area off", "[multigrid]") {
  const TriangleMesh mesh = small_sheet();
  const MeshLevel level =
      level_of(mesh, {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}});
  // The second lies over the first one's far half, wound against it.
  const LevelFaults faults = level_faults(level, mesh);
  CHECK(faults.turned_triangles == 1);
  CHECK(faults.covered_share == Approx((2 - 1) / 4.0));
}

TEST_CASE("level faults: a triangle without area counts as turned", "[multigrid]") {
  const TriangleMesh mesh = small_sheet();
  const MeshLevel level = level_of(mesh, {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}, {{0, 1, 2}});
  CHECK(level_faults(level, mesh).turned_triangles == 1);
}

TEST_CASE("level faults: borders through the middle have strayed", "[multigrid]") {
  const TriangleMesh mesh = small_sheet();
  const MeshLevel level =
      level_of(mesh, {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 1, 0}}, {{0, 1, 3}, {1, 2, 3}});
  const LevelFaults faults = level_faults(level, mesh);
  CHECK(faults.strayed_borders == 2);
  CHECK(faults.covered_share == Approx(0.5));
}

TEST_CASE("level faults: an edge of three triangles is crowded", "[multigrid]") {
  const TriangleMesh mesh = small_sheet();
  const MeshLevel level = level_of(mesh, {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 2, 0}},
                                   {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  CHECK(level_faults(level, mesh).crowded_edges == 1);
}

TEST_CASE("level faults: a hierarchy with its guards has none", "[multigrid]") {
  const auto pattern = GENERATE(from_range(kTriangulations));
  CAPTURE(static_cast<int>(pattern));
  const TriangleMesh mesh = triangulated_sheet(pattern, 24, 24, 0.1);
  for (const MeshLevel& level : mesh_hierarchy(mesh, {}, {}).levels) {
    const LevelFaults faults = level_faults(level, mesh);
    CHECK(faults.turned_triangles == 0);
    CHECK(faults.strayed_borders == 0);
    CHECK(faults.crowded_edges == 0);
    // The border of a jittered sheet is not quite straight.
    CHECK(faults.covered_share == Approx(1).epsilon(0.005));
  }
}

TEST_CASE("level faults: without all guards levels are still made, and faults are counted",
          "[multigrid]") {
  TriangleMesh mesh = triangulated_sheet(Triangulation::alternating, 24, 24, 1);
  Random random(1);
  mesh.rest_positions = shaken(mesh.rest_positions, 0.2, random);
  HierarchyOptions options;
  options.guards = {false, false, false};
  options.n_coarser = 8;
  const MeshHierarchy hierarchy = mesh_hierarchy(mesh, {}, options);
  REQUIRE(hierarchy.levels.size() > 5);
  const LevelFaults faults = level_faults(hierarchy.levels[3], mesh);
  CHECK(faults.turned_triangles > 0);
  CHECK(faults.strayed_borders > 0);
  CHECK(faults.covered_share < 0.97);
}

}  // namespace pleat
