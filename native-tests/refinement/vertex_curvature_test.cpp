#include "core/refinement/vertex_curvature.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

/// The arc's curvature by bisection of sin(a)/a = chord/length in long double.
long double bisected_curvature(long double chord, long double length) {
  // 1 - sin(a)/a as a series, as the difference itself cancels where the arc is nearly straight.
  const auto shortfall = [](long double a) {
    if (a > 0.5L) return 1 - std::sin(a) / a;
    long double sum = 0;
    for (int k = 12; k >= 1; --k) sum = a * a / (2 * k * (2 * k + 1)) * (1 - sum);
    return sum;
  };
  const long double e = (length - chord) / length;
  long double low = 0;
  long double high = 3.14159265358979323846264L;
  for (int i = 0; i < 200; ++i) {
    const long double middle = (low + high) / 2;
    (shortfall(middle) < e ? low : high) = middle;
  }
  return (low + high) / length;
}

/// Of a chord over two cells in direction (warp, weft) on a cylinder about weft.
double chord_curvature(double warp, double weft, double radius) {
  const double across = 2 * radius * std::sin(warp / (2 * radius));
  return static_cast<double>(bisected_curvature(std::hypot(across, weft), std::hypot(warp, weft)));
}

QuadMesh flat_sheet(int rows, int columns, double warp, double weft) {
  SheetShape shape;
  shape.rows = rows;
  shape.columns = columns;
  shape.height = rows * warp;
  shape.width = columns * weft;
  shape.warp_direction = {1, 0, 0};
  shape.weft_direction = {0, 1, 0};
  return QuadMesh::sheet(shape);
}

}  // namespace

TEST_CASE("vertex curvature: an arc's curvature is that of its chord to ten digits",
          "[refinement]") {
  const double length = GENERATE(1.0, 0.02);
  for (double e = 1e-12; e < 0.95; e *= 1.07) {
    const double chord = length * (1 - e);
    CAPTURE(length, e);
    const auto exact = static_cast<double>(bisected_curvature(chord, length));
    REQUIRE(exact > 0);
    CHECK(arc_curvature(chord, length) == Approx(exact).epsilon(1e-10).margin(0));
  }
  for (double r = 0.05; r < 1; r += 0.003) {
    CAPTURE(length, r);
    const auto exact = static_cast<double>(bisected_curvature(r * length, length));
    CHECK(arc_curvature(r * length, length) == Approx(exact).epsilon(1e-10).margin(0));
  }
}

TEST_CASE("vertex curvature: a chord as long as its arc or longer does not bend", "[refinement]") {
  CHECK(arc_curvature(1, 1) == 0);
  CHECK(arc_curvature(1.2, 1) == 0);
  CHECK(arc_curvature(0, 0.5) == Approx(2 * M_PI / 0.5).epsilon(1e-12));
  CHECK_THROWS_AS(arc_curvature(-0.1, 1), ContractError);
  CHECK_THROWS_AS(arc_curvature(0, 0), ContractError);
  CHECK_THROWS_AS(arc_curvature(1, -1), ContractError);
  CHECK_THROWS_AS(arc_curvature(std::nan(""), 1), ContractError);
}

TEST_CASE("vertex curvature: a cylinder has the mean of its eight chords everywhere",
          "[refinement]") {
  const double radius = GENERATE(0.03, 0.2, 5.0);
  const double angle = GENERATE(0.0, M_PI / 2);
  CAPTURE(radius, angle);
  constexpr double kWarp = 0.01;
  constexpr double kWeft = 0.015;
  const QuadMesh mesh = flat_sheet(8, 7, kWarp, kWeft);
  const Eigen::VectorXd curvature =
      VertexCurvature(mesh).of(on_cylinder(mesh.rest_positions(), angle, radius));
  const double along = angle == 0 ? 2 * kWarp : 2 * kWeft;
  const double across = angle == 0 ? 2 * kWeft : 2 * kWarp;
  const double diagonal = chord_curvature(along, across, radius);
  const RestCoordinates& uv = mesh.rest_coordinates();
  int n_inner = 0;
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    const auto both = [&](int thread, double step, int cells) {
      const auto place = std::lround(uv(thread, v) / step);
      return int{place >= 2} + int{place <= cells - 2};
    };
    const int n_warp = both(0, kWarp, 8);
    const int n_weft = both(1, kWeft, 7);
    const int n_along = angle == 0 ? n_warp : n_weft;
    const int n_across = angle == 0 ? n_weft : n_warp;
    const int n_diagonal = n_warp * n_weft;
    const double expected =
        (n_along / radius + n_diagonal * diagonal) / (n_along + n_across + n_diagonal);
    // A straight chord that is short by one rounding has a curvature of some 1e-6 / m.
    CHECK(curvature[v] == Approx(expected).epsilon(1e-10).margin(3e-6));
    n_inner += int{n_diagonal == 4};
  }
  CHECK(n_inner == 5 * 4);
}

TEST_CASE("vertex curvature: across levels a large cylinder bends alike", "[refinement]") {
  QuadMesh mesh = flat_sheet(8, 8, 0.01, 0.01);
  mesh.refine(std::array{FaceId(27), FaceId(28), FaceId(35)});
  REQUIRE(!mesh.hanging_vertices().empty());
  constexpr double kRadius = 2;
  const Positions rolled = on_cylinder(mesh.rest_positions(), 0, kRadius);
  const Eigen::VectorXd curvature = VertexCurvature(mesh).of(rolled);
  for (const HangingVertex& h : mesh.hanging_vertices())
    CHECK(curvature[h.vertex] ==
          Approx((curvature[h.parents[0]] + curvature[h.parents[1]]) / 2).epsilon(1e-14));
  for (Eigen::Index v = 0; v < curvature.size(); ++v) {
    CHECK(curvature[v] <= (1 + 1e-9) / kRadius);
    CHECK(curvature[v] > 0);
  }
}

TEST_CASE("vertex curvature: stretch alone and rigid motion do not bend", "[refinement]") {
  const QuadMesh mesh = flat_sheet(6, 6, 0.02, 0.02);
  const VertexCurvature of(mesh);
  CHECK(of.of(1.1 * mesh.rest_positions()).isZero(0));
  const Positions rolled = on_cylinder(mesh.rest_positions(), 0.3, 0.1);
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Positions moved = (turn * rolled).colwise() + Vec3(3, -2, 1);
  CHECK((of.of(moved) - of.of(rolled)).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("vertex curvature: a sheet too small for two steps has none", "[refinement]") {
  const QuadMesh mesh = flat_sheet(1, 1, 0.1, 0.1);
  const VertexCurvature of(mesh);
  CHECK(of.of(mesh.rest_positions()) == Eigen::VectorXd::Zero(4));
  CHECK_THROWS_AS(of.of(Positions::Zero(3, 5)), ContractError);
}

}  // namespace pleat
