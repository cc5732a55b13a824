#include "core/mesh/smooth_surface.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "native-tests/support/finite_difference.h"

namespace pleat {
namespace {

constexpr double kRadius = 0.3;  // [m]
constexpr int kRound = 24;       // faces around the tube
constexpr int kDown = 8;

QuadMesh tube() {
  QuadPatch patch;
  patch.rest_positions.resize(3, kRound * (kDown + 1));
  patch.rest_coordinates.resize(2, kRound * (kDown + 1));
  for (int r = 0; r <= kDown; ++r) {
    for (int c = 0; c < kRound; ++c) {
      const double angle = 2 * M_PI * c / kRound;
      patch.rest_positions.col(r * kRound + c) << kRadius * std::sin(angle), -0.07 * r,
          kRadius * std::cos(angle);
      patch.rest_coordinates.col(r * kRound + c) << 0.07 * r, 0.08 * c;
    }
  }
  const auto id = [](int r, int c) { return VertexId(r * kRound + c % kRound); };
  for (int r = 0; r < kDown; ++r)
    for (int c = 0; c < kRound; ++c)
      patch.quads.push_back({id(r, c), id(r + 1, c), id(r + 1, c + 1), id(r, c + 1)});
  return QuadMesh::from_patch(patch);
}

/// Farthest from the tube's cylinder [m], along the tube or off its axis.
double farthest_from_cylinder(const Positions& positions) {
  double farthest = 0;
  for (const auto& x : positions.colwise())
    farthest = std::max(farthest, std::abs(std::hypot(x.x(), x.z()) - kRadius));
  return farthest;
}

}  // namespace

// With an angle of a between vertices, a circle's tangent times the step is R sin(a) here, and the
// cubic's middle at R (cos(a/2) + sin(a) sin(a/2) / 4): 3/128 R a^4 too far inside, where the flat
// face's middle is R a^2 / 8 inside.
TEST_CASE("smooth surface: a refined tube is round", "[mesh]") {
  const QuadMesh base = tube();
  QuadMesh fine = base;
  fine.refine_uniformly(2);
  const double a = 2 * M_PI / kRound;
  const double middle = std::cos(a / 2) + std::sin(a) * std::sin(a / 2) / 4;
  CHECK(farthest_from_cylinder(fine.rest_positions()) ==
        Approx(kRadius * (1 - std::cos(a / 2))).epsilon(1e-9));
  CHECK(farthest_from_cylinder(on_smooth_surface(base, fine)) ==
        Approx(kRadius * (1 - middle)).epsilon(1e-9));
}

TEST_CASE("smooth surface: vertices keep the places that their base or a flat sheet gives them",
          "[mesh]") {
  const QuadMesh base = tube();
  QuadMesh fine = base;
  fine.refine_uniformly(1);
  CHECK(on_smooth_surface(base, fine).leftCols(base.n_vertices()) == base.rest_positions());

  const QuadMesh sheet = QuadMesh::sheet({0.3, 0.4, 3, 4});
  QuadMesh fine_sheet = sheet;
  fine_sheet.refine_uniformly(2);
  CHECK(relative_error(on_smooth_surface(sheet, fine_sheet), fine_sheet.rest_positions()) < 1e-14);
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
