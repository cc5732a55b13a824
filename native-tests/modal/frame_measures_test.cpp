#include "core/modal/frame_measures.h"

#include <catch2/catch.hpp>

#include "core/modal/box_surface.h"
#include "native-tests/support/analytic.h"
#include "native-tests/support/bars.h"

using namespace pleat;

TEST_CASE("frame_figures: the straight way between a bar and its arc loses volume", "[modal]") {
  const Vec3 sides(0.9, 0.2, 0.3);
  const BoxSurface box = box_surface(sides, 2);
  ModalOptions options;
  options.size = 0.1;
  options.n_modes = 12;
  const KeyCompletion completion({box.positions, bent(box.positions, kPi)}, box.triangles, options);
  const auto frames = completion.frames(5);
  const auto ours = frame_measures(completion, frames);
  const auto straight = linear_measures(completion, frames);
  REQUIRE(ours.size() == 5);
  REQUIRE(straight.size() == 5);
  CHECK(ours[0].volume == Approx(sides.prod()));
  CHECK(ours[0].strain < 1e-6);
  for (const std::size_t key : {std::size_t{0}, std::size_t{4}}) {
    CHECK(straight[key].volume == Approx(ours[key].volume));
    CHECK(straight[key].strain == Approx(ours[key].strain).margin(1e-9));
    CHECK(ours[key].unequal_halves == 0);
  }
  CHECK(ours[2].volume == Approx(sides.prod()).epsilon(0.02));
  CHECK(ours[2].n_inverted == 0);
  CHECK(ours[2].unequal_halves < 0.01);
  CHECK(straight[2].volume < 0.9 * sides.prod());
  CHECK(straight[2].strain > ours[2].strain);
}

// All stretched by a tenth along x: |F - R| is 0.1 everywhere.
TEST_CASE("frame_figures: the strain is that of the deformation gradients", "[modal]") {
  const BoxSurface box = box_surface({0.6, 0.2, 0.2}, 2);
  Positions stretched = box.positions;
  stretched.row(0) *= 1.1;
  ModalOptions options;
  options.size = 0.1;
  options.n_modes = 4;
  const KeyCompletion completion({box.positions, stretched}, box.triangles, options);
  const auto measures = frame_measures(completion, completion.frames(2));
  CHECK(measures[1].strain == Approx(0.1).epsilon(0.01));
  CHECK(measures[1].volume == Approx(1.1 * measures[0].volume).epsilon(0.01));
}
