#include "core/error/side_by_side.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/scene/format/scene_file.h"
#include "native-tests/support/cloth.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

Scene canvas_scene(int level) {
  Scene scene = released_sheet_scene(4, "canvas");
  scene.level = level;
  return scene;
}

FrameOptions half_a_second() {
  FrameOptions options;
  options.duration = 0.5;
  options.begin = 0.2;
  options.settled = 0;
  options.error_every = 3;
  return options;
}

std::vector<ContestantResult> run(const std::vector<Contestant>& contestants,
                                  const FrameOptions& options = half_a_second()) {
  SideBySide runs(contestants, options);
  while (!runs.done()) runs.advance();
  return runs.results();
}

}  // namespace

TEST_CASE("side by side: the same run twice has no error, another mesh has one", "[error]") {
  const auto results = run({{canvas_scene(1), {}}, {canvas_scene(1), {}}, {canvas_scene(0), {}}});
  REQUIRE(results.size() == 3);
  for (const ContestantResult& result : results) {
    CHECK(result.n_frames == 15);
    CHECK(result.frame_ms.size() == 9);
    CHECK(result.refinement_ms.empty());
    CHECK_FALSE(result.fit);
  }
  CHECK(results[1].errors.position < 1e-12);
  CHECK(results[1].errors.surface_rms < 1e-12);
  CHECK(results[1].errors.bend_distribution < 1e-9);
  CHECK(results[2].errors.position > 1e-4);
  CHECK(results[2].n_vertices == 25);
}

TEST_CASE("side by side: an adaptive run that never splits is as wrong as the coarse mesh",
          "[error]") {
  const auto results = run(
      {{canvas_scene(1), {}}, {canvas_scene(0), {}}, {canvas_scene(1), DynamicOptions{1e6, 1}}});
  CHECK(results[2].n_vertices == 25);
  CHECK(results[2].refinement_ms.size() == 9);
  CHECK(results[2].errors.position == Approx(results[1].errors.position).epsilon(0.05));
}

TEST_CASE("side by side: an adaptive run has more vertices where it splits", "[error]") {
  const auto results = run({{canvas_scene(1), {}}, {canvas_scene(1), DynamicOptions{0.05, 1}}});
  CHECK(results[1].n_vertices > 30);
  CHECK(results[1].n_vertices <= 81);
}

TEST_CASE("side by side: vertices inside of a solid are counted, pinned ones apart", "[error]") {
  Scene scene = canvas_scene(0);
  scene.colliders = {Collider{Sphere{Vec3(0, 0, 0), 0.1}, {}, 0.3}};
  const auto results = run({{scene, {}}});
  CHECK(results[0].all_inside.n_frames == 15);  // the pinned corner is its centre
  CHECK(results[0].all_inside.most == 1);
  CHECK(results[0].all_inside.deepest == Approx(0.1));
  CHECK(results[0].unpinned_inside.n_frames == 0);
}

TEST_CASE("side by side: the longest edge of all frames is stretched, however short others are",
          "[error]") {
  Scene scene = canvas_scene(1);
  const Positions at_rest = rest_cloth(scene).mesh.rest_positions;
  scene.start = StartState{0.7 * at_rest, Positions::Zero(3, at_rest.cols()), scene.level};
  const FrameOptions options = half_a_second();
  Simulation own(scene);
  double longest = 0, shortest = 0;
  while (own.time() < options.duration - scene.method.step / 2) {
    own.step();
    const auto frame = std::lround(own.time() / options.frame_time);
    if (std::abs(own.time() - static_cast<double>(frame) * options.frame_time) > 1e-9) continue;
    for (const GaugeEdge& edge : own.gauge()) {
      longest = std::max(longest, strain(edge, own.state().positions));
      shortest = std::min(shortest, strain(edge, own.state().positions));
    }
  }
  CHECK(run({{scene, {}}})[0].longest_edge == Approx(longest).epsilon(1e-12));
  CHECK(longest > 0);
  CHECK(-shortest > longest);
}

TEST_CASE("side by side: the parts of timed frames fit into their time", "[error]") {
  FrameOptions options = half_a_second();
  options.begin = options.duration - 2 * options.frame_time;  // two of fifteen frames
  const auto results = run({{canvas_scene(1), {}}}, options);
  double parts = 0;
  for (const double part : results[0].parts_ms) parts += part;
  REQUIRE(results[0].frame_ms.size() == 2);
  CHECK(parts > 0);
  CHECK(parts <= (results[0].frame_ms[0] + results[0].frame_ms[1]) / 2);
}

TEST_CASE("side by side: a run that ends early leaves the others their errors", "[error]") {
  Scene wild = canvas_scene(0);
  change_cloth<SheetCloth>(wild, [](SheetCloth& sheet) { sheet.initial_velocity = {1e13, 0, 0}; });
  const auto results = run({{canvas_scene(1), {}}, {wild, {}}, {canvas_scene(0), {}}});
  CHECK(results[1].report.ends_run());
  CHECK(std::isnan(results[1].errors.position));
  CHECK(results[2].errors.position > 0);
}

TEST_CASE("side by side: frames that steps do not divide are refused", "[error]") {
  FrameOptions options = half_a_second();
  options.frame_time = 0.01;
  CHECK_THROWS_AS(SideBySide({{canvas_scene(0), {}}}, options), InputError);
  options = half_a_second();
  options.begin = 0.5;
  CHECK_THROWS_AS(SideBySide({{canvas_scene(0), {}}}, options), InputError);
}

}  // namespace pleat
