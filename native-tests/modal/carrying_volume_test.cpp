#include "core/modal/carrying_volume.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "core/base/check.h"
#include "core/base/random.h"
#include "native-tests/support/bars.h"
#include "native-tests/support/meshes.h"

using namespace pleat;

namespace {

int n_parts(const std::vector<int>& parts) {
  return 1 + *std::max_element(parts.begin(), parts.end());
}

/// A sphere of radius 1 m: a box whose sides are cut and pushed outward.
struct Sphere {
  Positions positions;
  std::vector<Triangle> triangles;

  explicit Sphere(int levels) {
    TriangleMesh mesh;
    mesh.rest_positions = box_corners({2, 2, 2});
    mesh.triangles = box_triangles();
    mesh.warp_directions.assign(mesh.triangles.size(), Vec3(1, 0, 0));
    mesh = subdivided(std::move(mesh), levels);
    positions = mesh.rest_positions.colwise().normalized();
    triangles = mesh.triangles;
  }
};

/// Its tetrahedra have volume, its embedding puts the surface where it is.
void check(const CarryingVolume& carrying, const Positions& surface) {
  for (const Tet& tet : carrying.volume.tets)
    CHECK(tet_volume(carrying.volume.rest_positions, tet) > 0);
  CHECK((carrying.surface(carrying.volume.rest_positions) - surface).norm() <
        1e-12 * surface.norm());
  CHECK(carrying.embedding.nonZeros() <= 4 * surface.cols());
}

}  // namespace

TEST_CASE("lattice_volume: a box is filled to its sides", "[modal]") {
  const Positions corners = box_corners({0.4, 0.2, 0.1});
  const CarryingVolume bar = lattice_volume(corners, box_triangles(), 0.05);
  check(bar, corners);
  CHECK(bar.volume.tets.size() == 8u * 4 * 2 * 6);
  CHECK(bar.volume.n_vertices() == 9 * 5 * 3);
  CHECK(total_volume(bar.volume, bar.volume.rest_positions) == Approx(0.4 * 0.2 * 0.1));
}

// Lines through the cubes' middles meet edges and vertices of such a surface.
TEST_CASE("lattice_volume: a box is filled however its sides are cut", "[modal]") {
  TriangleMesh box;
  box.rest_positions = box_corners({0.4, 0.2, 0.2});
  box.triangles = box_triangles();
  box.warp_directions.assign(box.triangles.size(), Vec3(1, 0, 0));
  const int levels = GENERATE(1, 2, 3, 4);
  CAPTURE(levels);
  box = subdivided(std::move(box), levels);
  for (const double edge : {0.1, 0.05, 0.025}) {
    const CarryingVolume bar = lattice_volume(box.rest_positions, box.triangles, edge);
    check(bar, box.rest_positions);
    CHECK(total_volume(bar.volume, bar.volume.rest_positions) == Approx(0.4 * 0.2 * 0.2));
  }
}

TEST_CASE("lattice_volume: a sphere is covered, in one part, by little more than itself",
          "[modal]") {
  const Sphere sphere(3);
  const double edge = GENERATE(0.5, 0.21, 0.1);
  CAPTURE(edge);
  const CarryingVolume ball = lattice_volume(sphere.positions, sphere.triangles, edge);
  check(ball, sphere.positions);
  const double volume = total_volume(ball.volume, ball.volume.rest_positions);
  CHECK(volume > 4.0 / 3 * 3.14159 * 0.98);
  // No cube outside reaches farther than its diagonal.
  CHECK(volume < 4.0 / 3 * 3.14160 * std::pow(1 + std::sqrt(3.0) * edge, 3));
  CHECK(n_parts(parts_by_faces(ball.volume)) == 1);
  // Turned inside out it covers the same.
  std::vector<Triangle> turned = sphere.triangles;
  for (Triangle& triangle : turned) std::swap(triangle[1], triangle[2]);
  CHECK(lattice_volume(sphere.positions, turned, edge).volume.tets.size() ==
        ball.volume.tets.size());
}

TEST_CASE("lattice_volume: tetrahedra meet face to face", "[modal]") {
  const CarryingVolume bar = bar_volume({0.2, 0.2, 0.2}, 0.1);
  // Each of 8 cubes has 18 faces, 12 of them on its sides; 4 x 6 of 24 sides are outer ones.
  std::map<std::array<int, 3>, int> faces;
  for (const Tet& tet : bar.volume.tets)
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::array<int, 3> face{};
      for (std::size_t k = 0; k < 3; ++k) face[k] = tet[(left_out + 1 + k) % 4];
      std::sort(face.begin(), face.end());
      ++faces[face];
    }
  const auto n_outer =
      std::count_if(faces.begin(), faces.end(), [](const auto& face) { return face.second == 1; });
  CHECK(n_outer == 24 * 2);
  CHECK(std::all_of(faces.begin(), faces.end(), [](const auto& face) { return face.second <= 2; }));
}

TEST_CASE("lattice_volume: a surface that passes through itself is refused", "[modal]") {
  const Positions box = box_corners({1, 1, 1});
  Positions two(3, 16);
  two << box, box.colwise() + Vec3(0.5, 0.3, 0.2);
  std::vector<Triangle> triangles = box_triangles();
  for (const auto& [a, b, c] : box_triangles())
    triangles.push_back({VertexId(a + 8), VertexId(b + 8), VertexId(c + 8)});
  CHECK_THROWS_WITH(lattice_volume(two, triangles, 0.1), Catch::Contains("pass through itself"));
  // Apart, they are two.
  two.rightCols<8>() = box.colwise() + Vec3(3, 0, 0);
  CHECK_NOTHROW(lattice_volume(two, triangles, 0.1));
  // One side pulled through the other: what is behind is wound the other way round.
  Positions pulled = box;
  for (Eigen::Index v = 0; v < 8; ++v)
    if (pulled(0, v) > 0 && pulled(1, v) > 0) pulled(0, v) = -2;
  CHECK_THROWS_WITH(lattice_volume(pulled, box_triangles(), 0.1),
                    Catch::Contains("pass through itself"));
}

TEST_CASE("lattice_volume: an open or badly wound surface is refused", "[modal]") {
  const Positions corners = box_corners({1, 1, 1});
  std::vector<Triangle> open = box_triangles();
  open.pop_back();
  CHECK_THROWS_AS(lattice_volume(corners, open, 0.25), InputError);
  std::vector<Triangle> turned = box_triangles();
  std::swap(turned[0][1], turned[0][2]);
  CHECK_THROWS_AS(lattice_volume(corners, turned, 0.25), InputError);
  CHECK_THROWS_AS(lattice_volume(corners, box_triangles(), 1e-4), InputError);
}

TEST_CASE("shell_volume: a sheet is thickened by half to each side", "[modal]") {
  const TriangleMesh sheet = triangulated_sheet(
      GENERATE(from_range(std::begin(kTriangulations), std::end(kTriangulations))), 4, 5, 0.1);
  const CarryingVolume shell = shell_volume(sheet.rest_positions, sheet.triangles, 0.02);
  check(shell, sheet.rest_positions);
  double area = 0;
  for (std::size_t f = 0; f < sheet.triangles.size(); ++f) area += rest_area(sheet, FaceId(f));
  CHECK(total_volume(shell.volume, shell.volume.rest_positions) == Approx(0.02 * area));
  CHECK(n_parts(parts_by_faces(shell.volume)) == 1);
}

TEST_CASE("shell_volume: what hangs together at a vertex alone is refused", "[modal]") {
  Positions bow(3, 5);
  bow << 0, 1, 1, -1, -1, 0, 0, 1, 0, -1, 0, 0, 0, 0, 0;
  const std::vector<Triangle> triangles{{VertexId(0), VertexId(1), VertexId(2)},
                                        {VertexId(0), VertexId(3), VertexId(4)}};
  CHECK_THROWS_AS(shell_volume(bow, triangles, 0.1), InputError);
}

TEST_CASE("shell_volume: a closed surface is a hollow one, a crease is refused", "[modal]") {
  const Sphere sphere(2);
  check(shell_volume(sphere.positions, sphere.triangles, 0.1), sphere.positions);
  CHECK_THROWS_AS(shell_volume(sphere.positions, sphere.triangles, 4), InputError);
  std::vector<Triangle> turned = sphere.triangles;
  std::swap(turned[0][1], turned[0][2]);
  CHECK_THROWS_AS(shell_volume(sphere.positions, turned, 0.1), InputError);
}
