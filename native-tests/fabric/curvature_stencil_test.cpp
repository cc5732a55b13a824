#include "core/fabric/curvature_stencil.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "native-tests/support/analytic.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

constexpr double kMeshWidth = 0.1;  // [m]
/// Share of 1/kMeshWidth^2 times the values: rounding of second differences.
constexpr double kExact = 1e-9;

/// A flat mesh whose warp runs at `angle` [rad] from x.
TriangleMesh turned_sheet(Triangulation pattern, int rows, int columns, double angle) {
  TriangleMesh mesh = triangulated_sheet(pattern, rows, columns, kMeshWidth);
  mesh.warp_directions.assign(mesh.triangles.size(), {std::cos(angle), std::sin(angle), 0});
  return mesh;
}

/// Vertex 0 in the middle of a fan; vertices 1 to 6 at some angles [rad] on the unit circle.
TriangleMesh fan(const std::array<double, 6>& angles) {
  TriangleMesh mesh;
  mesh.rest_positions = Positions::Zero(3, 7);
  for (int k = 0; k < 6; ++k) {
    mesh.rest_positions.col(k + 1) << std::cos(angles[k]), std::sin(angles[k]), 0;
    mesh.triangles.push_back({VertexId(0), VertexId(k + 1), VertexId((k + 1) % 6 + 1)});
  }
  mesh.warp_directions.assign(6, Vec3::UnitX());
  return mesh;
}

/// f = 1 + 2 w + 3 v + 1/2 a w^2 + 1/2 b v^2 + c w v with w along the warp, v across.
constexpr double kAlong = 4;
constexpr double kAcross = -7;
constexpr double kMixed = 5;
double quadratic(const Vec3& x, const Vec3& warp) {
  const double w = warp.dot(x);
  const double v = Vec3::UnitZ().cross(warp).dot(x);
  return 1 + 2 * w + 3 * v + kAlong * w * w / 2 + kAcross * v * v / 2 + kMixed * w * v;
}

Vec3 derivatives(const CurvatureStencil& stencil, const Eigen::VectorXd& values) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < stencil.vertices.size(); ++i)
    sum += stencil.weights.col(static_cast<Eigen::Index>(i)) * values[stencil.vertices[i]];
  return sum;
}

/// Largest miss of the second derivatives of a quadratic over all triangles.
double largest_miss(const TriangleMesh& mesh) {
  const Vec3 warp = mesh.warp_directions.front();
  Eigen::VectorXd values(mesh.n_vertices());
  for (int i = 0; i < values.size(); ++i) values[i] = quadratic(mesh.rest_positions.col(i), warp);
  double miss = 0;
  for (const CurvatureStencil& stencil : curvature_stencils(mesh))
    miss = std::max(
        miss, (derivatives(stencil, values) - Vec3(kAlong, kAcross, kMixed)).cwiseAbs().maxCoeff());
  return miss;
}

}  // namespace

TEST_CASE("curvature_stencil: quadratics are exact on every mesh, borders included", "[fabric]") {
  const auto pattern = GENERATE(from_range(kTriangulations));
  const double angle = GENERATE(0.0, 0.5, 2.0);
  CAPTURE(pattern, angle);
  const TriangleMesh mesh = turned_sheet(pattern, 6, 7, angle);
  CHECK(largest_miss(mesh) < kExact);
  CHECK(curvature_stencils(mesh).size() == mesh.triangles.size());
}

TEST_CASE("curvature_stencil: needles are exact and finite", "[fabric]") {
  const auto pattern = GENERATE(from_range(kTriangulations));
  const double thinness = GENERATE(1e-2, 1e-5);
  CAPTURE(pattern, thinness);
  TriangleMesh mesh = turned_sheet(pattern, 4, 4, 0);
  mesh.rest_positions.row(1) *= thinness;
  // Second differences of values near 1 over a height of kMeshWidth * thinness.
  CHECK(largest_miss(mesh) < 1e-11 / std::pow(kMeshWidth * thinness, 2));
}

TEST_CASE("curvature_stencil: affine functions have no curvature in any mesh however small",
          "[fabric]") {
  const auto pattern = GENERATE(from_range(kTriangulations));
  const int columns = GENERATE(1, 2, 5);
  const TriangleMesh mesh = turned_sheet(pattern, 1, columns, 0.3);
  CAPTURE(pattern, columns);
  Eigen::VectorXd values = 3 * Eigen::VectorXd::Ones(mesh.n_vertices());
  values += mesh.rest_positions.transpose() * Vec3(1, -2, 0);
  for (const CurvatureStencil& stencil : curvature_stencils(mesh)) {
    REQUIRE(stencil.weights.cols() == static_cast<Eigen::Index>(stencil.vertices.size()));
    CHECK(derivatives(stencil, values).norm() < kExact);
  }
}

TEST_CASE("curvature_stencil: a strip of two lines sees what bends along it", "[fabric]") {
  const auto pattern =
      GENERATE(Triangulation::one_way, Triangulation::alternating, Triangulation::equilateral);
  const double angle = GENERATE(0.0, 0.5);
  CAPTURE(pattern, angle);
  const TriangleMesh mesh = turned_sheet(pattern, 1, 8, angle);
  // f = x^2/2 has the second derivatives of a projector on x.
  const Eigen::VectorXd values = mesh.rest_positions.row(0).cwiseAbs2().transpose() / 2;
  const double c = std::cos(angle);
  const double s = -std::sin(angle);
  for (const CurvatureStencil& stencil : curvature_stencils(mesh))
    CHECK((derivatives(stencil, values) - Vec3(c * c, s * s, c * s)).norm() < kExact);
}

TEST_CASE("curvature_stencil: a tail of two lines sees bending across from the next ring",
          "[fabric]") {
  TriangleMesh mesh = turned_sheet(Triangulation::one_way, 2, 2, 0);
  // Only the last cell of the second row stays.
  mesh.triangles.erase(mesh.triangles.begin() + 4, mesh.triangles.begin() + 6);
  mesh.warp_directions.resize(mesh.triangles.size());
  CHECK(largest_miss(mesh) < kExact);
}

TEST_CASE("curvature_stencil: six vertices on a conic are not used alone", "[fabric]") {
  // The triangle 0 2 4 of a hexagon on a circle and its flaps; around them a larger hexagon.
  TriangleMesh mesh;
  mesh.rest_positions.resize(3, 12);
  for (int k = 0; k < 6; ++k) {
    const double angle = k * kPi / 3;
    mesh.rest_positions.col(k) << std::cos(angle), std::sin(angle), 0;
    mesh.rest_positions.col(6 + k) << 2 * std::cos(angle), 2 * std::sin(angle), 0;
  }
  const auto add = [&](int a, int b, int c) {
    mesh.triangles.push_back({VertexId(a), VertexId(b), VertexId(c)});
  };
  add(0, 2, 4);
  for (int k = 0; k < 6; k += 2) add(k, k + 1, (k + 2) % 6);
  for (int k = 0; k < 6; ++k) {
    add(k, 6 + k, 6 + (k + 1) % 6);
    add(k, 6 + (k + 1) % 6, (k + 1) % 6);
  }
  mesh.warp_directions.assign(mesh.triangles.size(), Vec3::UnitX());
  CHECK(curvature_stencils(mesh).front().vertices.size() > 6);
  CHECK(largest_miss(mesh) < kExact);
}

TEST_CASE("curvature_stencil: a vertex of three triangles is used once", "[fabric]") {
  // Both flaps beside it are the same vertex.
  TriangleMesh mesh = fan({0, 1, 2, 3, 4, 5});
  mesh.rest_positions.conservativeResize(3, 8);
  mesh.rest_positions.col(7) =
      (mesh.rest_positions.col(0) + mesh.rest_positions.col(1) + mesh.rest_positions.col(2)) / 3;
  mesh.triangles.erase(mesh.triangles.begin());
  for (const auto& [a, b] : {std::pair(0, 1), {1, 2}, {2, 0}})
    mesh.triangles.push_back({VertexId(a), VertexId(b), VertexId(7)});
  mesh.warp_directions.assign(mesh.triangles.size(), Vec3::UnitX());
  for (const CurvatureStencil& stencil : curvature_stencils(mesh)) {
    std::vector<VertexId> vertices = stencil.vertices;
    std::sort(vertices.begin(), vertices.end());
    CHECK(std::adjacent_find(vertices.begin(), vertices.end()) == vertices.end());
  }
  CHECK(largest_miss(mesh) < kExact);
}

TEST_CASE("curvature_stencil: a triangle without a warp direction is refused", "[fabric]") {
  TriangleMesh mesh = turned_sheet(Triangulation::one_way, 2, 2, 0);
  mesh.warp_directions.pop_back();
  CHECK_THROWS_AS(curvature_stencils(mesh), ContractError);
}

}  // namespace pleat
