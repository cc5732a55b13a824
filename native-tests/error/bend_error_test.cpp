#include "core/error/bend_error.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/base/check.h"
#include "core/error/error_norms.h"
#include "core/run/carry_over.h"
#include "native-tests/support/analytic.h"
#include "native-tests/support/meshes.h"

using namespace pleat;

namespace {

constexpr double kEdge = 1.0 / 24;  // [m]

TriangleMesh unit_sheet(Triangulation pattern) {
  return triangulated_sheet(pattern, 24, 24, kEdge);
}

/// The sheet lifted to z = height(x, y).
template <class Height>
Positions lifted(Positions flat, Height&& height) {
  for (auto x : flat.colwise()) x[2] = height(x[0], x[1]);
  return flat;
}

/// Waves along x, this many in 1 m [m].
Positions wavy(const Positions& flat, double amplitude, int n_waves, double phase) {
  return lifted(
      flat, [=](double x, double) { return amplitude * std::sin(2 * kPi * n_waves * x + phase); });
}

/// The share of exp(i k s), s along a thread, that smoothing over `radius` leaves.
double hat_factor(double k, double radius) {
  const double half = k * radius / 2;
  return std::pow(std::sin(half) / half, 2);
}

/// The mean over a sheet of 1 m x 1 m, without curvature to compare with [1/m].
double mean_curvature(const BendMeasure& measure, const Positions& positions) {
  return measure.curvatures(positions).dot(measure.areas()) / measure.areas().sum();
}

}  // namespace

TEST_CASE("bend_error: the curvature of a quadratic surface is exact up to the border", "[error]") {
  const TriangleMesh mesh = unit_sheet(GENERATE(from_range(kTriangulations)));
  const BendMeasure measure(mesh, 3 * kEdge);
  const double warp = 0.7;
  const double weft = -1.1;
  const double twist = 0.4;
  const Positions surface = lifted(mesh.rest_positions, [&](double x, double y) {
    return (warp * x * x + weft * y * y) / 2 + twist * x * y + 3 * x - y;
  });
  const double exact = std::sqrt(warp * warp + weft * weft + 2 * twist * twist);
  for (const double curvature : measure.curvatures(surface))
    REQUIRE(curvature == Approx(exact).epsilon(1e-9));
  const Eigen::AngleAxisd turn(0.8, Vec3(1, 2, 2) / 3);
  const Positions elsewhere = (turn.toRotationMatrix() * surface).colwise() + Vec3(1, -2, 5);
  CHECK(measure.error(surface, elsewhere).distribution < 1e-9);
}

// Cells grow along x from nothing to twice the mean. Over far more than the sheet, its mean
// curvature is left: that of x^3/6 is x, whose mean by area is 1/2; by triangles it would be 1/3.
TEST_CASE("bend_error: smoothing weighs by area", "[error]") {
  TriangleMesh mesh = unit_sheet(Triangulation::alternating);
  mesh.rest_positions.row(0) = mesh.rest_positions.row(0).cwiseAbs2().eval();
  const Positions surface =
      lifted(mesh.rest_positions, [](double x, double) { return x * x * x / 6; });
  for (const double curvature : BendMeasure(mesh, 1e3).curvatures(surface))
    REQUIRE(curvature == Approx(0.5).epsilon(0.01));
}

// A fit over triangles of edge e lacks a share (k e)^2/12 of a circle's curvature k, 0.3 % here.
TEST_CASE("bend_error: cylinders are as different as their curvatures", "[error]") {
  const TriangleMesh mesh = unit_sheet(GENERATE(from_range(kTriangulations)));
  const double angle = GENERATE(0.0, 0.4, kPi / 2);
  const double radius = 2 * kEdge;
  const BendMeasure measure(mesh, radius);
  const double k_a = 1.5;
  const double k_b = 4;
  const BendError error = measure.error(on_cylinder(mesh.rest_positions, angle, 1 / k_a),
                                        on_cylinder(mesh.rest_positions, angle, 1 / k_b));
  const double exact = k_b * hat_factor(k_b, radius) - k_a * hat_factor(k_a, radius);
  CHECK(error.distribution == Approx(exact).epsilon(5e-3));
  CHECK(error.regions == Approx(exact).epsilon(5e-3));
}

TEST_CASE("bend_error: wrinkles may shift in phase but must be there", "[error]") {
  const TriangleMesh mesh = triangulated_sheet(Triangulation::equilateral, 48, 48, kEdge / 2);
  const BendMeasure measure(mesh, kEdge);
  const double amplitude = 0.01;
  const Positions& flat = mesh.rest_positions;
  const Positions wrinkled = wavy(flat, amplitude, 4, 0);
  const Positions shifted = wavy(flat, amplitude, 4, kPi / 2);
  const double mean = mean_curvature(measure, wrinkled);
  const double k = 8 * kPi;
  CHECK(mean == Approx(amplitude * k * k * 2 / kPi * hat_factor(k, kEdge)).epsilon(0.03));
  CHECK(measure.error(wrinkled, shifted).distribution < 0.02 * mean);
  CHECK(measure.error(wrinkled, shifted).regions < 0.05 * mean);
  CHECK(position_error(wrinkled, shifted, vertex_areas(mesh)) > 0.9 * amplitude);
  const BendError smoothed_out = measure.error(flat, wrinkled);
  CHECK(smoothed_out.distribution == Approx(mean).epsilon(1e-9));
  CHECK(smoothed_out.regions == Approx(mean).epsilon(1e-9));
}

TEST_CASE("bend_error: wrinkles on the other side are told by regions alone", "[error]") {
  const TriangleMesh mesh = unit_sheet(Triangulation::alternating);
  const BendMeasure measure(mesh, kEdge);
  const auto wrinkled_where = [&](bool left) {
    return lifted(mesh.rest_positions, [left](double x, double) {
      const double bump = std::pow(std::sin(4 * kPi * x), 3);
      return (x < 0.5) == left ? 0.01 * bump : 0;
    });
  };
  const Positions on_left = wrinkled_where(true);
  const BendError error = measure.error(on_left, wrinkled_where(false));
  const double mean = mean_curvature(measure, on_left);
  CHECK(error.distribution < 0.05 * mean);
  CHECK(error.regions == Approx(2 * mean).epsilon(0.05));
}

// Waves of 11 and 14 edges of a mesh with four times the spacing, as that mesh has them, against
// the waves themselves. Between its vertices a curve takes the place of the wave along mesh lines;
// elsewhere a chord does, which lacks a share (k h)^2/12 in each direction, 4 % together, and all
// of whose curvature is in its corners: these the smoothing must spread.
TEST_CASE("bend_error: one state on two meshes is hardly wrong once it is smoothed", "[error]") {
  const QuadMesh coarse = square_sheet(16);
  QuadMesh fine = coarse;
  fine.refine_uniformly(2);
  std::vector<std::array<VertexId, 2>> middles;
  const bool has_mesh_lines = GENERATE(true, false);
  const TriangleMesh mesh =
      has_mesh_lines ? fine.triangle_mesh() : subdivided(coarse.triangle_mesh(), 2, &middles);
  const auto wave = [](const Positions& rest) {
    Positions x = rest;
    for (auto place : x.colwise())
      place[2] = 0.02 * std::sin(9 * place[0]) * std::cos(7 * place[1]);
    return x;
  };
  const Positions exact = wave(mesh.rest_positions);
  const Positions known = wave(coarse.rest_positions());
  const Positions carried =
      has_mesh_lines ? carried_positions(known, fine) : subdivided_positions(known, middles);
  const BendMeasure smoothed(mesh, 1.0 / 16);
  const BendMeasure bare(mesh, 1e-6);
  const double mean = mean_curvature(smoothed, exact);
  const BendError error = smoothed.error(carried, exact);
  CAPTURE(has_mesh_lines, mean);
  CHECK(error.distribution < (has_mesh_lines ? 0.01 : 0.06) * mean);
  CHECK(error.regions < (has_mesh_lines ? 0.01 : 0.06) * mean);
  if (!has_mesh_lines) CHECK(bare.error(carried, exact).distribution > 0.5 * mean);
}

TEST_CASE("bend_error: weight is moved as far as the values differ in order", "[error]") {
  const Eigen::Vector4d weights(1, 2, 3, 4);
  const Eigen::Vector4d values(5, -1, 2, 0.5);
  CHECK(wasserstein_distance(values, values, weights) == 0);
  CHECK(wasserstein_distance(values, values.array() + 0.3, weights) == Approx(0.3));
  CHECK(wasserstein_distance(values, 2 * values, weights) ==
        Approx((5 + 2 * 1 + 3 * 2 + 4 * 0.5) / 10));
  const Eigen::Vector3d one_high(0, 1, 0);
  const Eigen::Vector3d two_high(1, 0, 1);
  CHECK(wasserstein_distance(one_high, two_high, Eigen::Vector3d::Ones()) == Approx(1.0 / 3));
  CHECK(wasserstein_distance(one_high, two_high, Eigen::Vector3d(1, 2, 1)) ==
        Approx(0).margin(1e-15));
}

TEST_CASE("bend_error: what cannot be compared is refused", "[error]") {
  const TriangleMesh mesh = unit_sheet(Triangulation::one_way);
  CHECK_THROWS_AS(BendMeasure(mesh, 0), ContractError);
  Positions broken = mesh.rest_positions;
  broken(1, 7) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(BendMeasure(mesh, kEdge).error(broken, mesh.rest_positions), ContractError);
  const Eigen::Vector2d values(1, 2);
  CHECK_THROWS_AS(wasserstein_distance(values, values, Eigen::Vector2d::Zero()), ContractError);
  CHECK_THROWS_AS(wasserstein_distance(values, values, Eigen::Vector3d::Ones()), ContractError);
}
