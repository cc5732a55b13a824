#include "core/hierarchy/edge_collapse.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/base/check.h"
#include "core/mesh/mesh_fault.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

TriangleMesh mesh_of(const std::vector<Vec3>& places, std::vector<Triangle> triangles) {
  TriangleMesh mesh;
  mesh.rest_positions.resize(3, static_cast<Eigen::Index>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i)
    mesh.rest_positions.col(static_cast<Eigen::Index>(i)) = places[i];
  mesh.triangles = std::move(triangles);
  return mesh;
}

Triangle corners(int a, int b, int c) { return {VertexId(a), VertexId(b), VertexId(c)}; }

/// A strip along x, two vertices wide, closed to a ring of `n` squares that stands upright.
TriangleMesh ring(int n) {
  std::vector<Vec3> places;
  std::vector<Triangle> triangles;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979323846 * i / n;
    places.emplace_back(std::cos(angle), std::sin(angle), 0);
    places.emplace_back(std::cos(angle), std::sin(angle), 1);
    const int a = 2 * i, b = 2 * ((i + 1) % n);
    triangles.push_back(corners(a, b, b + 1));
    triangles.push_back(corners(a, b + 1, a + 1));
  }
  return mesh_of(places, triangles);
}

/// The regular octahedron.
TriangleMesh octahedron() {
  return mesh_of({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                 {corners(0, 2, 4), corners(2, 1, 4), corners(1, 3, 4), corners(3, 0, 4),
                  corners(2, 0, 5), corners(1, 2, 5), corners(3, 1, 5), corners(0, 3, 5)});
}

/// A flat star: the middle lies where it sees every side, and its neighbour 1 sees only some.
TriangleMesh star() {
  return mesh_of({{0, 0, 0},
                  {0.9, 0, 0},
                  {2, 3, 0},
                  {1, 0.5, 0},
                  {-2, 3, 0},
                  {-2, -3, 0},
                  {1, -0.5, 0},
                  {2, -3, 0}},
                 {corners(0, 1, 3), corners(0, 3, 2), corners(0, 2, 4), corners(0, 4, 5),
                  corners(0, 5, 7), corners(0, 7, 6), corners(0, 6, 1)});
}

/// Mesh after collapses, with its vertices numbered anew.
TriangleMesh left_of(const EdgeCollapse& collapse, const TriangleMesh& mesh) {
  const std::vector<VertexId> vertices = collapse.vertices();
  TriangleMesh left;
  left.rest_positions.resize(3, static_cast<Eigen::Index>(vertices.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i)
    left.rest_positions.col(static_cast<Eigen::Index>(i)) = mesh.rest_positions.col(vertices[i]);
  for (Triangle t : collapse.triangles()) {
    for (VertexId& v : t)
      v = VertexId(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin());
    left.triangles.push_back(t);
  }
  return left;
}

double total_area(const TriangleMesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 x0 = mesh.rest_positions.col(a);
    area += (Vec3(mesh.rest_positions.col(b)) - x0)
                .cross(Vec3(mesh.rest_positions.col(c)) - x0)
                .norm() /
            2;
  }
  return area;
}

int euler_characteristic(const TriangleMesh& mesh) {
  return mesh.n_vertices() - static_cast<int>(mesh_edges(mesh.triangles).size()) +
         static_cast<int>(mesh.triangles.size());
}

bool is_left(const EdgeCollapse& collapse, int vertex) {
  const std::vector<VertexId> left = collapse.vertices();
  return std::count(left.begin(), left.end(), VertexId(vertex)) > 0;
}

/// How far from every vertex that is left a place of the sheet may be (the middles of its triangles
/// are looked at), over the mean spacing sqrt(area / vertices). A square grid has 0.71, a hexagonal
/// one 0.62.
double largest_hole(const TriangleMesh& left, const TriangleMesh& mesh) {
  double largest = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 middle = (mesh.rest_positions.col(t[0]) + mesh.rest_positions.col(t[1]) +
                         mesh.rest_positions.col(t[2])) /
                        3;
    const std::array<double, 3> at = {middle.x(), middle.y(), middle.z()};
    // Tests are built without optimisation, and this is nearly all that this one does.
    double nearest = std::numeric_limits<double>::max();
    const double* const x = left.rest_positions.data();
    for (Eigen::Index k = 0; k < left.rest_positions.size(); k += 3) {
      const double dx = x[k] - at[0], dy = x[k + 1] - at[1], dz = x[k + 2] - at[2];
      nearest = std::min(nearest, dx * dx + dy * dy + dz * dz);
    }
    largest = std::max(largest, nearest);
  }
  return std::sqrt(largest) / std::sqrt(total_area(mesh) / left.n_vertices());
}

}  // namespace

TEST_CASE("quadric: of a plane it is the weighted squared distance, in whole numbers",
          "[multigrid]") {
  const Quadric plane = Quadric::of_plane({0, 0, 3}, {0, 0, 1}, 2);
  CHECK(plane.at({7, -5, 3}) == 0);
  CHECK(plane.at({7, -5, 5}) == 8);
  CHECK(plane.at({0, 0, 0}) == 18);
}

TEST_CASE("quadric: of a point it is the weighted squared distance, in whole numbers",
          "[multigrid]") {
  const Quadric point = Quadric::of_point({1, 2, 3}, 4);
  CHECK(point.at({1, 2, 3}) == 0);
  CHECK(point.at({1, 2, 5}) == 16);
  CHECK(point.at({2, 4, 5}) == 36);
}

TEST_CASE("quadric: sums add", "[multigrid]") {
  Quadric sum = Quadric::of_plane({1, 0, 0}, {1, 0, 0}, 1);
  sum += Quadric::of_plane({0, 2, 0}, {0, 1, 0}, 3);
  sum += Quadric::of_point({0, 0, 0}, 1);
  CHECK(sum.at({3, 4, 5}) == 4 + 3 * 4 + 50);
}

TEST_CASE("collapse: the cheapest goes first, a vertex on a plane before one on a ridge",
          "[multigrid]") {
  // A roof: the ridge at y = 0, planes falling to both sides.
  TriangleMesh mesh = triangulated_sheet(Triangulation::one_way, 8, 8, 1);
  for (Eigen::Index v = 0; v < mesh.rest_positions.cols(); ++v)
    mesh.rest_positions(2, v) = -std::abs(mesh.rest_positions(1, v) - 4);
  EdgeCollapse collapse(mesh, {});
  REQUIRE(collapse.reach(40));
  // Only those of the ridge's nine between its ends could go, along it, at the cost of points.
  const TriangleMesh left = left_of(collapse, mesh);
  CHECK(total_area(left) == Approx(total_area(mesh)).epsilon(1e-9));
}

TEST_CASE("collapse: on a flat sheet what is left is spread evenly", "[multigrid]") {
  const auto pattern = GENERATE(from_range(kTriangulations));
  CAPTURE(static_cast<int>(pattern));
  const TriangleMesh mesh = triangulated_sheet(pattern, 64, 64, 1);
  EdgeCollapse collapse(mesh, {});
  for (int n = mesh.n_vertices() / 2; n > 300; n /= 2) {
    CAPTURE(n);
    REQUIRE(collapse.reach(n));
    CHECK(largest_hole(left_of(collapse, mesh), mesh) <= 1.2);
  }
}

TEST_CASE("collapse: what is left is a sound mesh of the same kind, down to a few vertices",
          "[multigrid]") {
  const auto pattern = GENERATE(from_range(kTriangulations));
  const auto seed = GENERATE(1u, 2u, 3u);
  CAPTURE(static_cast<int>(pattern), seed);
  TriangleMesh mesh = triangulated_sheet(pattern, 20, 20, 1);
  Random random(seed);
  mesh.rest_positions = shaken(mesh.rest_positions, 0.2, random);
  EdgeCollapse collapse(mesh, {});
  for (int n = mesh.n_vertices() / 2; n > 20; n /= 2) {
    if (!collapse.reach(n)) break;
    const TriangleMesh left = left_of(collapse, mesh);
    CHECK(left.n_vertices() == n);
    const auto fault = mesh_fault(left.rest_positions, left.triangles, 0);
    CAPTURE(fault ? fault->sentence : "");
    CHECK_FALSE(fault);
    CHECK(euler_characteristic(left) == 1);
  }
  CHECK(collapse.n_vertices() < mesh.n_vertices() / 2);
}

TEST_CASE("collapse: fixed vertices stay until the last", "[multigrid]") {
  const TriangleMesh mesh = triangulated_sheet(Triangulation::alternating, 8, 8, 1);
  std::vector<bool> is_fixed(static_cast<std::size_t>(mesh.n_vertices()), false);
  is_fixed[30] = is_fixed[40] = is_fixed[41] = true;
  EdgeCollapse collapse(mesh, is_fixed);
  CHECK_FALSE(collapse.reach(3));
  for (const int v : {30, 40, 41}) CHECK(is_left(collapse, v));
}

TEST_CASE("collapse: corners stay and borders keep their lines", "[multigrid]") {
  const TriangleMesh mesh = triangulated_sheet(Triangulation::one_way, 6, 6, 1);
  EdgeCollapse collapse(mesh, {});
  collapse.reach(4);
  const TriangleMesh left = left_of(collapse, mesh);
  CHECK(left.n_vertices() == 4);
  CHECK(total_area(left) == Approx(36));
}

TEST_CASE("collapse: triangles are not turned over", "[multigrid]") {
  const TriangleMesh mesh = star();
  REQUIRE_FALSE(mesh_fault(mesh.rest_positions, mesh.triangles, 0));
  EdgeCollapse collapse(mesh, {});
  collapse.reach(3);
  const TriangleMesh left = left_of(collapse, mesh);
  for (const auto& [a, b, c] : left.triangles) {
    const Vec3 x0 = left.rest_positions.col(a);
    CHECK((Vec3(left.rest_positions.col(b)) - x0).cross(Vec3(left.rest_positions.col(c)) - x0).z() >
          0);
  }
}

TEST_CASE("collapse: a ring stays a ring", "[multigrid]") {
  const TriangleMesh mesh = ring(12);
  EdgeCollapse collapse(mesh, {});
  CHECK_FALSE(collapse.reach(4));
  const TriangleMesh left = left_of(collapse, mesh);
  CHECK(euler_characteristic(left) == 0);
  CHECK_FALSE(mesh_fault(left.rest_positions, left.triangles, 0));
}

TEST_CASE("collapse: without the guard of flips a triangle turns over", "[multigrid]") {
  const TriangleMesh mesh = star();
  CollapseGuards guards;
  guards.flips = false;
  EdgeCollapse collapse(mesh, {}, guards);
  collapse.reach(7);
  const TriangleMesh left = left_of(collapse, mesh);
  CHECK(std::any_of(left.triangles.begin(), left.triangles.end(), [&](const Triangle& t) {
    const Vec3 x0 = left.rest_positions.col(t[0]);
    return (Vec3(left.rest_positions.col(t[1])) - x0)
               .cross(Vec3(left.rest_positions.col(t[2])) - x0)
               .z() < 0;
  }));
}

TEST_CASE("collapse: without the guard of borders corners go and the sheet shrinks",
          "[multigrid]") {
  const TriangleMesh mesh = triangulated_sheet(Triangulation::one_way, 6, 6, 1);
  CollapseGuards guards;
  guards.borders = false;
  EdgeCollapse collapse(mesh, {}, guards);
  REQUIRE(collapse.reach(20));
  const TriangleMesh left = left_of(collapse, mesh);
  CHECK(total_area(left) < 0.95 * 36);
  CHECK_FALSE(mesh_fault(left.rest_positions, left.triangles, 0));
}

TEST_CASE("collapse: a closed surface ends as a tetrahedron", "[multigrid]") {
  const TriangleMesh mesh = octahedron();
  EdgeCollapse collapse(mesh, {});
  CHECK_FALSE(collapse.reach(3));
  const TriangleMesh left = left_of(collapse, mesh);
  CHECK(left.n_vertices() >= 4);
  CHECK(euler_characteristic(left) == 2);
}

TEST_CASE(
    "collapse: without the guard of links a closed surface ends as two triangles, back to back",
    "[multigrid]") {
  const TriangleMesh mesh = octahedron();
  CollapseGuards guards;
  guards.links = false;
  EdgeCollapse collapse(mesh, {}, guards);
  REQUIRE(collapse.reach(3));
  const TriangleMesh left = left_of(collapse, mesh);
  CHECK(left.triangles.size() == 2);
  CHECK(mesh_fault(left.rest_positions, left.triangles, 0));
}

TEST_CASE("collapse: where two fans touch in a vertex it stays", "[multigrid]") {
  const TriangleMesh mesh =
      mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 0, 0}, {-1, -1, 0}, {0, -1, 0}},
              {corners(0, 1, 2), corners(0, 2, 3), corners(0, 4, 5), corners(0, 5, 6)});
  EdgeCollapse collapse(mesh, {});
  collapse.reach(3);
  CHECK(is_left(collapse, 0));
}

TEST_CASE("collapse: a single triangle stays", "[multigrid]") {
  const TriangleMesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {corners(0, 1, 2)});
  EdgeCollapse collapse(mesh, {});
  CHECK_FALSE(collapse.reach(2));
  CHECK(collapse.n_vertices() == 3);
}

TEST_CASE("collapse: neither place nor size of a mesh decides", "[multigrid]") {
  const double scale = GENERATE(1e-6, 1e6);
  TriangleMesh mesh = triangulated_sheet(Triangulation::jittered, 16, 16, 1);
  EdgeCollapse here(mesh, {});
  REQUIRE(here.reach(100));
  mesh.rest_positions *= scale;
  mesh.rest_positions.colwise() += scale * Vec3(100, 50, -20);
  EdgeCollapse there(mesh, {});
  REQUIRE(there.reach(100));
  CHECK(here.vertices() == there.vertices());
}

TEST_CASE("collapse: an unsound mesh is refused", "[multigrid]") {
  const TriangleMesh fin = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                                   {corners(0, 1, 2), corners(1, 0, 3), corners(0, 1, 4)});
  CHECK_THROWS_AS(EdgeCollapse(fin, {}), ContractError);
  const TriangleMesh turned =
      mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, {corners(0, 1, 2), corners(0, 1, 3)});
  CHECK_THROWS_AS(EdgeCollapse(turned, {}), ContractError);
}

}  // namespace pleat
