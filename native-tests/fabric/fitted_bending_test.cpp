#include "core/fabric/fitted_bending.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "native-tests/support/analytic.h"
#include "native-tests/support/finite_difference.h"
#include "native-tests/support/linear_systems.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

constexpr double kRadius = 1;        // [m]
constexpr double kEdge = 1.0 / 12;   // [m]: a turn of 0.083 rad over an edge
constexpr double kTolerance = 0.01;  // promised at that turn

double energy(const SparseMatrix& Q, const Positions& x) {
  return 0.5 * (x * full_of(Q) * x.transpose()).trace();
}

/// The rest shape of a row-wise mesh folded up by a quarter turn along the line y = `height` [m].
TriangleMesh folded(TriangleMesh mesh, double height) {
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    double mean = 0;
    for (const VertexId v : mesh.triangles[f]) mean += mesh.rest_positions.col(v).y() / 3;
    Vec3& warp = mesh.warp_directions[f];
    if (mean > height) warp = {warp.x(), 0, warp.y()};
  }
  for (auto x : mesh.rest_positions.colwise()) {
    if (x.y() > height) x = Vec3(x.x(), height, x.y() - height);
  }
  return mesh;
}

}  // namespace

TEST_CASE("fitted_bending: a cylinder costs the same in every direction", "[fabric]") {
  const auto pattern = GENERATE(from_range(kTriangulations));
  const TriangleMesh mesh = triangulated_sheet(pattern, 12, 12, kEdge);
  const double area = vertex_areas(mesh).sum();
  const SparseMatrix Q = fitted_bending(mesh, 3, 3, 3);
  for (int degrees = 0; degrees <= 180; degrees += 15) {
    CAPTURE(pattern, degrees);
    const Positions x = on_cylinder(mesh.rest_positions, degrees * kPi / 180, kRadius);
    CHECK(energy(Q, x) == Approx(0.5 * 3 * area / (kRadius * kRadius)).epsilon(kTolerance));
  }
}

TEST_CASE("fitted_bending: warp, weft and torsion have their own rigidities", "[fabric]") {
  const auto pattern = GENERATE(from_range(kTriangulations));
  TriangleMesh mesh = triangulated_sheet(pattern, 12, 12, kEdge);
  const double warp_angle = 0.4;
  mesh.warp_directions.assign(mesh.triangles.size(),
                              {std::cos(warp_angle), std::sin(warp_angle), 0});
  const double area = vertex_areas(mesh).sum();
  const auto [warp, weft, twist] = GENERATE(
      table<double, double, double>({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {5, 2, std::sqrt(10.0)}}));
  const SparseMatrix Q = fitted_bending(mesh, warp, weft, twist);
  for (int degrees = 0; degrees <= 180; degrees += 15) {
    CAPTURE(pattern, warp, weft, twist, degrees);
    const double angle = degrees * kPi / 180;  // angle between warp and the direction that bends
    const double along = std::pow(std::cos(angle), 2);
    const double across = std::pow(std::sin(angle), 2);
    const double rigidity =
        warp * along * along + weft * across * across + 2 * twist * along * across;
    const Positions x = on_cylinder(mesh.rest_positions, warp_angle + angle, kRadius);
    const double largest = std::max({warp, weft, twist / 2});
    CHECK(energy(Q, x) / (0.5 * area / (kRadius * kRadius)) ==
          Approx(rigidity).epsilon(0).margin(kTolerance * largest));
  }
}

TEST_CASE("fitted_bending: the energy of a cylinder converges with the square of the edge",
          "[fabric]") {
  const auto pattern = GENERATE(from_range(kTriangulations));
  const auto error = [&](int cells) {
    const TriangleMesh mesh = triangulated_sheet(pattern, cells, cells, 1.0 / cells);
    const Positions x = on_cylinder(mesh.rest_positions, 0.3, kRadius);
    const double exact = 0.5 * vertex_areas(mesh).sum() / (kRadius * kRadius);
    return std::abs(energy(fitted_bending(mesh, 1, 1, 1), x) / exact - 1);
  };
  CAPTURE(pattern);
  CHECK(std::log2(error(8) / error(16)) == Approx(2).margin(0.3));
}

TEST_CASE("fitted_bending: moving and turning the sheet costs nothing", "[fabric]") {
  const auto pattern = GENERATE(from_range(kTriangulations));
  CAPTURE(pattern);
  const TriangleMesh mesh = triangulated_sheet(pattern, 6, 6, kEdge);
  const SparseMatrix Q = fitted_bending(mesh, 4, 2, 3);
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Positions moved = (turn * mesh.rest_positions).colwise() + Vec3(3, -2, 1);
  Random random(1);
  CHECK(std::abs(energy(Q, moved)) < 1e-12 * energy(Q, shaken(mesh.rest_positions, kEdge, random)));
}

TEST_CASE("fitted_bending: only affine functions cost nothing, on strips too", "[fabric]") {
  const auto pattern = GENERATE(from_range(kTriangulations));
  const int rows = GENERATE(1, 2, 7);
  CAPTURE(pattern, rows);
  const SparseMatrix Q = fitted_bending(triangulated_sheet(pattern, rows, 7, kEdge), 1, 1, 1);
  const Eigen::VectorXd values = full_of(Q).selfadjointView<Eigen::Lower>().eigenvalues();
  const double largest = values.tail<1>()[0];
  CHECK(values.head<3>().cwiseAbs().maxCoeff() < 1e-13 * largest);
  CHECK(values[3] > 1e-6 * largest);  // the softest wave over 7 edges, (2 pi/7)^4/1000 or more
}

TEST_CASE("fitted_bending: a mesh of one or two triangles moves freely as it should", "[fabric]") {
  TriangleMesh mesh = triangulated_sheet(Triangulation::one_way, 1, 1, kEdge);
  CHECK(full_of(fitted_bending(mesh, 1, 1, 1)).fullPivLu().rank() == 1);  // the fold
  mesh.triangles.pop_back();
  mesh.warp_directions.pop_back();
  const SparseMatrix Q = fitted_bending(mesh, 1, 1, 1);
  CHECK(full_of(Q).isZero(0));
  CHECK(Q.nonZeros() >= mesh.n_vertices());  // the diagonal, that of the loose vertex too
}

TEST_CASE("fitted_bending: a sheet at rest in a fold bends like the flat one", "[fabric]") {
  const auto pattern = GENERATE(Triangulation::one_way, Triangulation::alternating,
                                Triangulation::crossed, Triangulation::equilateral);
  CAPTURE(pattern);
  TriangleMesh flat = triangulated_sheet(pattern, 6, 4, kEdge);
  flat.warp_directions.assign(flat.triangles.size(), {0.8, 0.6, 0});
  const double third_row = flat.rest_positions(1, 3 * 5);
  const TriangleMesh bent = folded(flat, third_row);
  REQUIRE((bent.rest_positions - flat.rest_positions).norm() > kEdge);
  CHECK(relative_error(full_of(fitted_bending(bent, 5, 2, 1)),
                       full_of(fitted_bending(flat, 5, 2, 1))) < 1e-12);
}

TEST_CASE("fitted_bending: a negative rigidity is refused", "[fabric]") {
  const TriangleMesh mesh = triangulated_sheet(Triangulation::one_way, 1, 1, kEdge);
  CHECK_THROWS_AS(fitted_bending(mesh, 1, -1, 1), ContractError);
}

}  // namespace pleat
