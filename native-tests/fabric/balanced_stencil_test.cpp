#include "core/fabric/balanced_stencil.h"

#include <Eigen/SparseCholesky>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/fabric/fitted_bending.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

constexpr double kSpacing = 0.1;  // [m]

double quadratic(const Vec3& x) {
  return 0.5 * x.x() * x.x() + 0.7 * x.x() * x.y() - 1.3 * x.y() * x.y() + 2 * x.x() - 3;
}
const Vec3 kItsDerivatives(1, -2.6, 0.7);

/// Vertices that are further than this from the box around a flat mesh.
std::vector<VertexId> inner_vertices(const TriangleMesh& mesh, double distance) {
  std::vector<char> near_border(static_cast<std::size_t>(mesh.n_vertices()), 0);
  for (const MeshEdge& edge : mesh_edges(mesh.triangles)) {
    if (!edge.is_border()) continue;
    for (int i = 0; i < mesh.n_vertices(); ++i)
      if ((mesh.rest_positions.col(i) - mesh.rest_positions.col(edge.a)).norm() <= distance)
        near_border[static_cast<std::size_t>(i)] = 1;
  }
  std::vector<VertexId> inner;
  for (int i = 0; i < mesh.n_vertices(); ++i)
    if (near_border[static_cast<std::size_t>(i)] == 0) inner.emplace_back(i);
  return inner;
}

/// A strip of n edges behind a clamp of two pinned rows, a quarter as wide as long, sags under its
/// weight: the depth of its tip, in shares of the beam's w L^4 / (8 B).
double sag(Triangulation pattern, int n) {
  const double edge = 1.0 / n;
  TriangleMesh mesh = triangulated_sheet(pattern, n / 4, n + 1, edge);
  const Eigen::VectorXd weights = vertex_areas(mesh);
  const auto Q = fitted_bending(mesh, 1, 1, 1);
  std::vector<int> unknown(static_cast<std::size_t>(mesh.n_vertices()), -1);
  int n_unknowns = 0;
  for (int i = 0; i < mesh.n_vertices(); ++i)
    if (mesh.rest_positions(0, i) > 1.01 * edge)
      unknown[static_cast<std::size_t>(i)] = n_unknowns++;
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < Q.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(Q, column); entry; ++entry) {
      const int i = unknown[static_cast<std::size_t>(entry.row())];
      const int j = unknown[static_cast<std::size_t>(column)];
      if (i >= 0 && j >= 0) entries.emplace_back(i, j, entry.value());
    }
  SparseMatrix A(n_unknowns, n_unknowns);
  A.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd load(n_unknowns);
  for (int i = 0; i < mesh.n_vertices(); ++i)
    if (unknown[static_cast<std::size_t>(i)] >= 0)
      load[unknown[static_cast<std::size_t>(i)]] = weights[i];
  const Eigen::SimplicialLDLT<SparseMatrix> factor(A);
  const Eigen::VectorXd depth = factor.solve(load);
  double sum = 0;
  int count = 0;
  for (int i = 0; i < mesh.n_vertices(); ++i) {
    if (mesh.rest_positions(0, i) < 1 + 0.99 * edge) continue;
    sum += depth[unknown[static_cast<std::size_t>(i)]];
    ++count;
  }
  return sum / count * 8;
}

}  // namespace

TEST_CASE("balanced_stencil: second derivatives of a quadratic are exact", "[fabric]") {
  const auto pattern = GENERATE(from_range(kTriangulations));
  const TriangleMesh mesh = triangulated_sheet(pattern, 8, 9, kSpacing);
  for (const CurvatureStencil& stencil : balanced_stencils(mesh)) {
    Vec3 found = Vec3::Zero();
    for (std::size_t k = 0; k < stencil.vertices.size(); ++k)
      found += stencil.weights.col(static_cast<Eigen::Index>(k)) *
               quadratic(mesh.rest_positions.col(stencil.vertices[k]));
    CAPTURE(pattern, found);
    CHECK((found - kItsDerivatives).norm() < 1e-9);
  }
}

TEST_CASE("balanced_stencil: constant curvature needs no forces away from the border", "[fabric]") {
  const auto pattern = GENERATE(from_range(kTriangulations));
  const TriangleMesh mesh = triangulated_sheet(pattern, 12, 12, kSpacing);
  const std::vector<VertexId> inner = inner_vertices(mesh, 3.2 * kSpacing);
  REQUIRE(inner.size() >= 9);
  Eigen::Matrix<double, 3, Eigen::Dynamic> sums =
      Eigen::Matrix<double, 3, Eigen::Dynamic>::Zero(3, mesh.n_vertices());
  double largest = 0;
  for (const CurvatureStencil& stencil : balanced_stencils(mesh)) {
    for (std::size_t k = 0; k < stencil.vertices.size(); ++k) {
      const Vec3 term = stencil.area * stencil.weights.col(static_cast<Eigen::Index>(k));
      sums.col(stencil.vertices[k]) += term;
      largest = std::max(largest, term.norm());
    }
  }
  CAPTURE(pattern);
  for (const VertexId v : inner) CHECK(sums.col(v).norm() < 1e-10 * largest);
}

TEST_CASE("balanced_stencil: parallelograms keep the stencils of the fit", "[fabric]") {
  const auto pattern = GENERATE(Triangulation::one_way, Triangulation::equilateral);
  const TriangleMesh mesh = triangulated_sheet(pattern, 8, 8, kSpacing);
  int n_compact = 0;
  for (const CurvatureStencil& stencil : balanced_stencils(mesh))
    n_compact += stencil.vertices.size() == 6 ? 1 : 0;
  CHECK(n_compact > 40);
}

TEST_CASE("balanced_stencil: a fan of hundreds of triangles stays cheap", "[fabric]") {
  // The cap of a cylinder: every vertex on one circle, which is a conic.
  constexpr int kCorners = 300;
  TriangleMesh mesh;
  mesh.rest_positions.resize(3, kCorners);
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * 3.141592653589793 * i / kCorners;
    mesh.rest_positions.col(i) << std::cos(angle), std::sin(angle), 0;
  }
  for (int i = 1; i + 1 < kCorners; ++i)
    mesh.triangles.push_back({VertexId(0), VertexId(i), VertexId(i + 1)});
  mesh.warp_directions.assign(mesh.triangles.size(), Vec3::UnitX());
  for (const CurvatureStencil& stencil : balanced_stencils(mesh)) {
    CHECK(stencil.vertices.size() < 250);
    CHECK(stencil.weights.allFinite());
  }
}

TEST_CASE("fitted_bending: a cantilever's sag converges to the beam's on any triangulation",
          "[fabric]") {
  const auto pattern =
      GENERATE(Triangulation::one_way, Triangulation::alternating, Triangulation::crossed);
  const double coarse = std::abs(sag(pattern, 20) - 1);
  const double fine = std::abs(sag(pattern, 40) - 1);
  CAPTURE(pattern, coarse, fine);
  // Two pinned rows clamp to first order.
  CHECK(fine < 0.03);
  CHECK(std::log2(coarse / fine) == Approx(1).margin(0.2));
}

}  // namespace pleat
