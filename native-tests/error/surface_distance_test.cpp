#include "core/error/surface_distance.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/base/check.h"
#include "core/base/random.h"
#include "native-tests/support/analytic.h"
#include "native-tests/support/meshes.h"

using namespace pleat;

namespace {

struct Surface {
  std::vector<Triangle> triangles;
  Positions positions;
};

SurfaceError error_between(const Surface& a, const Surface& b) {
  return surface_error(a.triangles, a.positions, b.triangles, b.positions);
}

/// The unit square in the plane z = 0.
Surface square(int cells) {
  const QuadMesh mesh = square_sheet(cells);
  Surface surface{mesh.triangles(), Positions::Zero(3, mesh.n_vertices())};
  surface.positions.topRows(2) = mesh.rest_coordinates();
  return surface;
}

/// Square lifted to z = height(x, y).
template <class Height>
Surface graph(int cells, Height&& height) {
  Surface surface = square(cells);
  for (Eigen::Index i = 0; i < surface.positions.cols(); ++i)
    surface.positions(2, i) = height(surface.positions(0, i), surface.positions(1, i));
  return surface;
}

/// A cap of a sphere about the origin, 1 rad by 1 rad of longitude and latitude.
Surface cap(int cells, double radius) {
  Surface surface = square(cells);
  for (auto x : surface.positions.colwise()) {
    const double longitude = x[0];
    const double latitude = x[1] - 0.5;
    x = radius * Vec3(std::cos(latitude) * std::cos(longitude),
                      std::cos(latitude) * std::sin(longitude), std::sin(latitude));
  }
  return surface;
}

Surface triangle(const Vec3& x0, const Vec3& x1, const Vec3& x2) {
  Surface surface{{{VertexId(0), VertexId(1), VertexId(2)}}, Positions(3, 3)};
  surface.positions << x0, x1, x2;
  return surface;
}

}  // namespace

TEST_CASE("surface_distance: a plane shifted along its normal is wrong by the shift", "[error]") {
  const Surface plane = square(GENERATE(1, 4));
  Surface shifted = square(7);
  const double shift = GENERATE(0.03, -2.0);
  shifted.positions.row(2).array() += shift;
  const SurfaceError error = error_between(plane, shifted);
  CHECK(error.rms == Approx(std::abs(shift)).epsilon(1e-14));
  CHECK(error.percentile_95 == Approx(std::abs(shift)).epsilon(1e-14));
  CHECK(error.largest == Approx(std::abs(shift)).epsilon(1e-14));
}

// Slid in its own plane by d, a strip d wide of each square sticks out: the points there are
// d - x away, all others 0.
TEST_CASE("surface_distance: a plane slid along itself is wrong at its border alone", "[error]") {
  const double slide = 0.2;
  const Surface plane = square(60);
  Surface slid = plane;
  slid.positions.row(0).array() += slide;
  const SurfaceError error = error_between(plane, slid);
  CHECK(error.rms == Approx(std::sqrt(slide * slide * slide / 3)).epsilon(2e-3));
  CHECK(error.percentile_95 == Approx(slide - 0.05).epsilon(0.02));
}

// Each square's two triangles have four points each, centroids of parts of edge h = 1/(2 cells);
// such parts lack h^2/18 of the mean of x^2, which is 1/3.
TEST_CASE("surface_distance: a tilted plane is wrong by the height of its points", "[error]") {
  const int cells = GENERATE(1, 2, 9);
  const double angle = 0.3;
  Surface tilted = square(cells);
  tilted.positions.row(2) = std::sin(angle) * tilted.positions.row(0);
  tilted.positions.row(0) *= std::cos(angle);
  const double h = 0.5 / cells;
  CHECK(error_between(tilted, square(cells)).rms ==
        Approx(std::sin(angle) * std::sqrt(1.0 / 3 - h * h / 18)).epsilon(1e-13));
}

TEST_CASE(
    "surface_distance: concentric caps are apart by their radii's difference, at second order",
    "[error]") {
  std::vector<double> differences;
  for (const int cells : {4, 8, 16}) {
    const SurfaceError error = error_between(cap(cells, 1), cap(2 * cells, 1.1));
    differences.push_back(error.rms - 0.1);
    CHECK(error.percentile_95 == Approx(0.1).margin(0.2 / (cells * cells)));
  }
  CHECK(differences[0] / differences[1] == Approx(4).epsilon(0.1));
  CHECK(differences[1] / differences[2] == Approx(4).epsilon(0.1));
}

TEST_CASE("surface_distance: a surface is not wrong against itself, split or turned over",
          "[error]") {
  Random random(3);
  Surface surface = square(5);
  surface.positions = shaken(surface.positions, 0.1, random);
  TriangleMesh mesh{surface.positions, surface.triangles,
                    std::vector<Vec3>(surface.triangles.size(), Vec3::UnitX())};
  mesh = subdivided(std::move(mesh), 2);
  Surface split{mesh.triangles, mesh.rest_positions};
  for (Triangle& t : split.triangles) std::swap(t[0], t[1]);
  CHECK(error_between(surface, split).rms < 1e-15);
  CHECK(error_between(split, surface).percentile_95 < 1e-15);
}

TEST_CASE(
    "surface_distance: meshes of one surface are as wrong as they are coarse, at second order",
    "[error]") {
  const auto wave = [](double x, double y) { return 0.1 * std::sin(5 * x) * std::cos(3 * y); };
  const Surface fine = graph(64, wave);
  const double coarse_error = error_between(graph(8, wave), fine).rms;
  const double middle_error = error_between(graph(16, wave), fine).rms;
  CHECK(coarse_error / middle_error == Approx(4.2).epsilon(0.1));
}

// The error between two surfaces should be theirs, not their meshes'.
TEST_CASE("surface_distance: the error hardly depends on either mesh", "[error]") {
  const auto wave = [](double x, double) { return 0.02 * std::sin(2 * kPi * x); };
  const double exact = error_between(graph(96, wave), square(96)).rms;
  CHECK(exact == Approx(0.02 / std::sqrt(2.0)).epsilon(0.02));
  for (const int cells : {24, 40})
    CHECK(error_between(graph(cells, wave), square(64 - cells)).rms == Approx(exact).epsilon(0.02));
}

TEST_CASE("surface_distance: a triangle far away is as far as its nearest points", "[error]") {
  const Surface plane = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Surface point_like = triangle({0, 0, 1000}, {1e-9, 0, 1000}, {0, 1e-9, 1000});
  const SurfaceError error = error_between(plane, point_like);
  CHECK(error.rms == Approx(1000).epsilon(1e-6));
  CHECK(error.percentile_95 == Approx(1000).epsilon(1e-6));
}

// A ridge of that width and 1 cm height, with a slope as wide.
TEST_CASE("surface_distance: the percentile tells a small bump from a large one", "[error]") {
  const auto [width, percentile] = GENERATE(std::pair(0.03, 0.0), std::pair(0.1, 0.01));
  const double edge = width;
  const auto ridge = [edge](double x, double) { return x <= edge + 1e-9 ? 0.01 : 0.0; };
  const SurfaceError error = error_between(graph(100, ridge), square(50));
  CHECK(error.percentile_95 == Approx(percentile).margin(1e-12));
  CHECK(error.rms == Approx(0.01 * std::sqrt(width + 0.005)).epsilon(0.05));
}

TEST_CASE("surface_distance: triangles without area have no points but can be nearest", "[error]") {
  Surface plane = square(2);
  Surface other = square(2);
  other.positions.row(2).setConstant(1);
  const double before = error_between(plane, other).rms;
  const VertexId corner(0);
  plane.triangles.push_back({corner, corner, VertexId(1)});
  plane.triangles.push_back({corner, corner, corner});
  CHECK(error_between(plane, other).rms == Approx(before).epsilon(1e-14));
  const Surface line = triangle({0, 0, 0}, {1, 0, 0}, {0.5, 0, 0});
  const Surface above = triangle({0, 0, 2}, {1, 0, 2}, {0.5, 0, 2});
  CHECK(error_between(line, above).rms == Approx(2).epsilon(1e-14));
  const Surface point = triangle({0, 0, 3}, {0, 0, 3}, {0, 0, 3});
  CHECK(error_between(line, point).percentile_95 > 3);
}

TEST_CASE("surface_distance: needles and sizes do not matter", "[error]") {
  const double scale = GENERATE(1e-8, 1.0, 1e8);
  Surface needles = square(3);
  needles.positions.row(0) *= 1000 * scale;
  needles.positions.row(1) *= scale;
  Surface shifted = needles;
  shifted.positions.row(2).array() += 0.3 * scale;
  CHECK(error_between(needles, shifted).rms == Approx(0.3 * scale).epsilon(1e-12));
}

TEST_CASE("surface_distance: nothing and places that are no numbers are refused", "[error]") {
  const Surface plane = square(1);
  Surface broken = plane;
  broken.positions(1, 2) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(error_between(plane, broken), ContractError);
  CHECK_THROWS_AS(error_between({{}, plane.positions}, plane), ContractError);
}
