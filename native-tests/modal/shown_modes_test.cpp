#include "core/modal/shown_modes.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/modal/box_surface.h"
#include "native-tests/support/analytic.h"
#include "native-tests/support/bars.h"

using namespace pleat;

namespace {

const Vec3 kBox(0.9, 0.2, 0.3);

double enclosed_by(const Positions& places, const std::vector<Triangle>& triangles) {
  double six = 0;
  for (const auto& [a, b, c] : triangles)
    six += places.col(a).dot(places.col(b).cross(places.col(c)));
  return six / 6;
}

ModalOptions box_options(int n_modes) {
  ModalOptions options;
  options.size = 0.1;
  options.n_modes = n_modes;
  return options;
}

double farthest_in(const Eigen::MatrixXd& moves, Eigen::Index mode) {
  return moves.col(mode).reshaped(3, moves.rows() / 3).colwise().norm().maxCoeff();
}

}  // namespace

TEST_CASE("box_surface: a closed box of squares, wound outward", "[modal]") {
  const int cells = GENERATE(1, 2, 3);
  CAPTURE(cells);
  const BoxSurface box = box_surface(kBox, cells);
  CHECK(is_closed(box.triangles));
  CHECK(enclosed_by(box.positions, box.triangles) == Approx(kBox.prod()));
  CHECK(box.positions.rowwise().maxCoeff().isApprox(kBox / 2));
  CHECK(box.positions.rowwise().minCoeff().isApprox(-kBox / 2));
  // Euler: V - E + F = 2 with E = 3 F / 2.
  CHECK(2 * box.positions.cols() - static_cast<Eigen::Index>(box.triangles.size()) == 4);
  const Vec3 longest =
      box.positions.col(box.triangles[0][1]) - box.positions.col(box.triangles[0][0]);
  CHECK(longest.norm() < 1.5 * kBox.minCoeff() / cells);
}

TEST_CASE("box_surface: no box is a sentence", "[modal]") {
  CHECK_THROWS_AS(box_surface({1, 0, 1}, 2), InputError);
  CHECK_THROWS_AS(box_surface({1, 1, 1}, 0), InputError);
  CHECK_THROWS_AS(box_surface({1000, 1, 1000}, 100), InputError);
}

TEST_CASE("surface_modes: rigid motions are left out, the farthest vertex moves by 1", "[modal]") {
  const BoxSurface box = box_surface(kBox, 2);
  const SurfaceModes inside = volume_surface_modes(box.positions, box.triangles, box_options(4));
  const SurfaceModes alone = surface_modes(box.positions, box.triangles, 4);
  CHECK(inside.n_tets == 6 * 9 * 2 * 3);
  CHECK(alone.n_tets == 0);
  for (const SurfaceModes& modes : {inside, alone}) {
    CHECK(modes.n_rigid == 6);
    REQUIRE(modes.moves.cols() == 4);
    CHECK(modes.stiffness.minCoeff() > 0);
    for (Eigen::Index m = 0; m < 4; ++m) CHECK(farthest_in(modes.moves, m) == Approx(1));
  }
  CHECK_THROWS_AS(surface_modes(box.positions, box.triangles, 100000), InputError);
  Positions more(3, box.positions.cols() + 1);
  more << box.positions, Vec3(9, 9, 9);
  CHECK_THROWS_AS(surface_modes(more, box.triangles, 4), InputError);
}

TEST_CASE("surface_modes: shares of a motion climb to all of what its modes span", "[modal]") {
  const BoxSurface box = box_surface(kBox, 2);
  const KeyCompletion completion({box.positions, bent(box.positions, 1)}, box.triangles,
                                 box_options(12));
  const Eigen::VectorXd shares = volume_motion_shares(completion, completion.frames(5));
  REQUIRE(shares.size() == 6 + 12);
  for (Eigen::Index m = 1; m < shares.size(); ++m) CHECK(shares[m] >= shares[m - 1]);
  CHECK(shares[shares.size() - 1] > 0.9);
}
