#include "core/mesh/smooth_surface.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/base/check.h"
#include "native-tests/support/finite_difference.h"

namespace pleat {
namespace {

constexpr double kRadius = 0.3;  // [m]
constexpr int kFacesRound = 24;  // faces around the tube
constexpr int kFacesDown = 8;

/// Vertices at these angles round a cylinder, closed or not.
QuadMesh tube(const std::vector<double>& angles, bool is_closed) {
  const int round = static_cast<int>(angles.size());
  QuadPatch patch;
  patch.rest_positions.resize(3, round * (kFacesDown + 1));
  patch.rest_coordinates.resize(2, round * (kFacesDown + 1));
  for (int r = 0; r <= kFacesDown; ++r) {
    for (int c = 0; c < round; ++c) {
      const double angle = angles[static_cast<std::size_t>(c)];
      patch.rest_positions.col(r * round + c) << kRadius * std::sin(angle), -0.07 * r,
          kRadius * std::cos(angle);
      patch.rest_coordinates.col(r * round + c) << 0.07 * r, 0.08 * c;
    }
  }
  const auto id = [round](int r, int c) { return VertexId(r * round + c % round); };
  for (int r = 0; r < kFacesDown; ++r)
    for (int c = 0; c < (is_closed ? round : round - 1); ++c)
      patch.quads.push_back({id(r, c), id(r + 1, c), id(r + 1, c + 1), id(r, c + 1)});
  return QuadMesh::from_patch(patch);
}

/// Angles all round, every other one further on by a share of the step.
std::vector<double> angles_round(double shift) {
  std::vector<double> angles(kFacesRound);
  for (int c = 0; c < kFacesRound; ++c)
    angles[static_cast<std::size_t>(c)] = 2 * M_PI * (c + (c % 2) * shift) / kFacesRound;
  return angles;
}

QuadMesh tube() { return tube(angles_round(0), true); }

/// The place of the middle of the edge between two base vertices.
Vec3 middle_on_surface(const QuadMesh& base, int a, int b) {
  QuadMesh fine = base;
  fine.refine_uniformly(1);
  return on_smooth_surface(base, fine).col(fine.middle(VertexId(a), VertexId(b)));
}

/// Farthest from the tube's cylinder [m], along the tube or off its axis.
double farthest_from_cylinder(const Positions& positions) {
  double farthest = 0;
  for (const auto& x : positions.colwise())
    farthest = std::max(farthest, std::abs(std::hypot(x.x(), x.z()) - kRadius));
  return farthest;
}

}  // namespace

// With an angle of a between vertices, an edge is 2 R sin(a/2) long, and so is its tangent: the
// cubic's middle is at R (cos(a/2) + sin(a/2)^2 / 2), R a^4 / 128 inside, where the flat face's is
// R a^2 / 8 inside.
TEST_CASE("smooth surface: a refined tube is round", "[mesh]") {
  const QuadMesh base = tube();
  QuadMesh fine = base;
  fine.refine_uniformly(2);
  const double a = 2 * M_PI / kFacesRound;
  const double middle = std::cos(a / 2) + std::pow(std::sin(a / 2), 2) / 2;
  CHECK(farthest_from_cylinder(fine.rest_positions()) ==
        Approx(kRadius * (1 - std::cos(a / 2))).epsilon(1e-9));
  CHECK(farthest_from_cylinder(on_smooth_surface(base, fine)) ==
        Approx(kRadius * (1 - middle)).epsilon(1e-9));
}

TEST_CASE("smooth surface: edges of unequal lengths have the circle's tangents", "[mesh]") {
  const std::vector<double> angles = angles_round(0.4);
  const double a = angles[1] - angles[0];
  const double radius = kRadius * (std::cos(a / 2) + std::pow(std::sin(a / 2), 2) / 2);
  const Vec3 middle = middle_on_surface(tube(angles, true), 0, 1);
  CHECK(std::hypot(middle.x(), middle.z()) == Approx(radius).epsilon(1e-12));
}

// With a tangent T at its inner end alone, an edge has (3 chord - T) / 2 at the other.
TEST_CASE("smooth surface: a line's end has no curvature", "[mesh]") {
  const QuadMesh half = tube({0, 0.3, 0.6, 0.9}, false);
  const Vec3 p0 = half.rest_positions().col(0);
  const Vec3 p1 = half.rest_positions().col(1);
  const Vec3 chord = p1 - p0;
  const Vec3 tangent = chord.norm() * Vec3(std::cos(0.3), 0, -std::sin(0.3));
  const Vec3 expected = (p0 + p1) / 2 + (3 * chord - tangent) / 16 - tangent / 8;
  CHECK((middle_on_surface(half, 0, 1) - expected).norm() < 1e-15);
}

TEST_CASE("smooth surface: a line that turns sharply ends there", "[mesh]") {
  const QuadMesh wedge = tube({0, 1.2, 2.4}, false);
  const Vec3 middle = middle_on_surface(wedge, 0, 1);
  CHECK((middle - (wedge.rest_positions().col(0) + wedge.rest_positions().col(1)) / 2).norm() <
        1e-15);
}

TEST_CASE("smooth surface: base vertices keep their places", "[mesh]") {
  const QuadMesh base = tube();
  QuadMesh fine = base;
  fine.refine_uniformly(1);
  CHECK(on_smooth_surface(base, fine).leftCols(base.n_vertices()) == base.rest_positions());
  CHECK_THROWS_AS(on_smooth_surface(fine, base), ContractError);
}

TEST_CASE("smooth surface: a flat sheet stays as it is", "[mesh]") {
  const QuadMesh sheet = QuadMesh::sheet({0.3, 0.4, 3, 4});
  QuadMesh fine = sheet;
  fine.refine_uniformly(2);
  CHECK(relative_error(on_smooth_surface(sheet, fine), fine.rest_positions()) < 1e-14);
}

TEST_CASE("smooth surface: one vertex has one place on any mesh that has it", "[mesh]") {
  const QuadMesh base = tube();
  QuadMesh fine = base;
  fine.refine_uniformly(2);
  QuadMesh graded = base;
  graded.refine(std::vector<FaceId>{FaceId(40), FaceId(41), FaceId(90)});
  const Positions on_fine = on_smooth_surface(base, fine);
  const Positions on_graded = on_smooth_surface(base, graded);
  std::vector<bool> hangs(static_cast<std::size_t>(graded.n_vertices()), false);
  REQUIRE(!graded.hanging_vertices().empty());
  for (const HangingVertex& h : graded.hanging_vertices()) {
    hangs[h.vertex] = true;
    const Vec3 middle = (on_graded.col(h.parents[0]) + on_graded.col(h.parents[1])) / 2;
    CHECK(on_graded.col(h.vertex) == middle);
  }
  int n_compared = 0;
  for (int i = base.n_vertices(); i < graded.n_vertices(); ++i) {
    if (hangs[static_cast<std::size_t>(i)]) continue;
    const Vec3 flat = graded.rest_positions().col(i);
    Eigen::Index same = 0;
    REQUIRE((fine.rest_positions().colwise() - flat).colwise().norm().minCoeff(&same) < 1e-12);
    CHECK((on_fine.col(same) - on_graded.col(i)).norm() < 1e-12);
    ++n_compared;
  }
  CHECK(n_compared >= 3);
}

}  // namespace pleat
