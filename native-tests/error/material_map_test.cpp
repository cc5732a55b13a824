#include "core/error/material_map.h"

#include <catch2/catch.hpp>

#include "native-tests/support/graded_sheets.h"

namespace pleat {
namespace {

Positions transformed(const Positions& places) {
  Mat3 matrix;
  matrix << 1.2, 0.3, -0.1, 0.2, 0.8, 0.4, -0.3, 0.1, 1.1;
  return (matrix * places).colwise() + Vec3(3, -2, 5);
}

}  // namespace

TEST_CASE("material map: an affine motion is carried exactly between any two meshes", "[error]") {
  const std::uint64_t seed = GENERATE(1, 2, 3);
  const QuadMesh mesh = graded_sheet(seed);
  const QuadMesh other = square_sheet(7);
  const MaterialMap map(mesh.triangle_mesh(), other.rest_positions());
  CHECK(map.farthest() < 1e-12);
  const Positions expected = transformed(other.rest_positions());
  CHECK((map.of(transformed(mesh.rest_positions())) - expected).norm() < 1e-12);
}

TEST_CASE("material map: a mesh's own vertices keep their places to rounding", "[error]") {
  const QuadMesh mesh = graded_sheet(4);
  Random random(5);
  const Positions moved = shaken(mesh.rest_positions(), 0.1, random);
  const MaterialMap map(mesh.triangle_mesh(), mesh.rest_positions());
  const Positions found = map.of(moved);
  std::vector<bool> hangs(static_cast<std::size_t>(mesh.n_vertices()), false);
  for (const HangingVertex& h : mesh.hanging_vertices()) hangs[h.vertex] = true;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (!hangs[static_cast<std::size_t>(v)]) CHECK((found.col(v) - moved.col(v)).norm() < 1e-12);
}

TEST_CASE("material map: points off the mesh have its nearest place and tell how far they are",
          "[error]") {
  const QuadMesh mesh = square_sheet(2);
  const TriangleMesh triangles = mesh.triangle_mesh();
  const Vec3 a = triangles.rest_positions.col(triangles.triangles[0][0]);
  const Vec3 b = triangles.rest_positions.col(triangles.triangles[0][1]);
  const Vec3 c = triangles.rest_positions.col(triangles.triangles[0][2]);
  const Vec3 normal = (b - a).cross(c - a).normalized();
  Positions points(3, 2);
  points << (a + b + c) / 3 + 0.25 * normal, a;
  const MaterialMap map(triangles, points);
  CHECK(map.farthest() == Approx(0.25));
  CHECK((map.of(mesh.rest_positions()).col(0) - (a + b + c) / 3).norm() < 1e-12);
}

}  // namespace pleat
