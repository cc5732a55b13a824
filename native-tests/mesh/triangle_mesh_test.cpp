#include "core/mesh/triangle_mesh.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/mesh/quad_mesh.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

VertexId v(int i) { return VertexId(i); }

TEST_CASE("triangle_mesh: a sheet has the edges that Euler's formula asks for", "[mesh]") {
  const int cells = GENERATE(1, 2, 5);
  const QuadMesh sheet = square_sheet(cells);
  const TriangleMesh mesh = sheet.triangle_mesh();
  const std::vector<MeshEdge> edges = mesh_edges(mesh.triangles);
  const int n_faces = 2 * cells * cells;
  CHECK(mesh.n_vertices() - static_cast<int>(edges.size()) + n_faces == 1);
  int n_borders = 0;
  for (const MeshEdge& edge : edges) n_borders += edge.is_border() ? 1 : 0;
  CHECK(n_borders == 4 * cells);
}

TEST_CASE("triangle_mesh: an edge knows the corner across it on both sides", "[mesh]") {
  const std::vector<MeshEdge> edges = mesh_edges({{v(0), v(1), v(2)}, {v(2), v(1), v(3)}});
  REQUIRE(edges.size() == 5);
  const MeshEdge& shared = edges[1];
  CHECK((shared.a == v(1) && shared.b == v(2)));
  CHECK(shared.across[0] == v(0));
  CHECK(shared.across[1] == v(3));
  CHECK(edges[0].is_border());
  CHECK_FALSE(shared.is_border());
}

TEST_CASE("triangle_mesh: three triangles at an edge are refused", "[mesh]") {
  CHECK_THROWS_AS(mesh_edges({{v(0), v(1), v(2)}, {v(1), v(0), v(3)}, {v(0), v(1), v(4)}}),
                  ContractError);
}

TEST_CASE("triangle_mesh: subdivision keeps vertices, area and thread directions", "[mesh]") {
  const TriangleMesh mesh = square_sheet(3).triangle_mesh();
  std::vector<std::array<VertexId, 2>> middles;
  const TriangleMesh fine = subdivided(mesh, 2, &middles);
  CHECK(fine.triangles.size() == 16 * mesh.triangles.size());
  CHECK(fine.rest_positions.leftCols(mesh.n_vertices()) == mesh.rest_positions);
  CHECK(fine.n_vertices() == mesh.n_vertices() + static_cast<int>(middles.size()));
  CHECK(vertex_areas(fine).sum() == Approx(1.0).epsilon(1e-12));
  CHECK(fine.warp_directions.size() == fine.triangles.size());
  // A refined sheet has as many vertices, so no middle was made twice.
  QuadMesh refined = square_sheet(3);
  refined.refine_uniformly(2);
  CHECK(fine.n_vertices() == refined.n_vertices());
}

TEST_CASE("triangle_mesh: a direction is projected into the plane or refused", "[mesh]") {
  const Vec3 x0(0, 0, 0), x1(1, 0, 0), x2(0, 1, 0);
  CHECK((direction_in_plane({1, 0, 5}, x0, x1, x2) - Vec3(1, 0, 0)).norm() < 1e-12);
  CHECK(direction_in_plane({0, 0, 1}, x0, x1, x2).isZero(0));
  CHECK(direction_in_plane({1, 0, 0}, x0, x1, x1).isZero(0));
}

}  // namespace
}  // namespace pleat
