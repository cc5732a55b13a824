#include "core/run/adaptive_run.h"

#include <catch2/catch.hpp>
#include <map>

#include "core/base/check.h"
#include "core/model/elasticity.h"
#include "core/run/simulation.h"
#include "core/scene/cloth/particle_cloth.h"
#include "native-tests/support/cloth.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

/// A sheet of half a metre that hangs from two corners, so that it is bent everywhere.
Scene hanging_scene() {
  Scene scene = released_sheet_scene(12, "canvas");
  change_cloth<SheetCloth>(scene, [](SheetCloth& sheet) {
    sheet.shape.width = sheet.shape.height = 0.5;
    sheet.shape.warp_direction = {0, -1, 0};
    sheet.initial_velocity = {0, 0, 0.05};
  });
  scene.pins = {{"upper_left", {Motion::Kind::move, Vec3(0.03, 0, 0), 0, 0.5, 0}},
                {"upper_right", {}}};
  scene.method.substeps = 2;
  return scene;
}

using Places = std::map<std::pair<double, double>, Vec3>;

/// Keyed by rest coordinates, of which refinement takes exact means.
Places places(const AdaptiveRun& run) {
  Places all;
  for (int v = 0; v < run.mesh()->n_vertices(); ++v) {
    const auto uv = run.mesh()->rest_coordinates().col(v);
    all[{uv[0], uv[1]}] = run.state().positions.col(v);
  }
  return all;
}

double largest_jump(const Places& before, const Places& after) {
  double largest = 0;
  for (const auto& [uv, place] : after)
    if (const auto at = before.find(uv); at != before.end())
      largest = std::max(largest, (place - at->second).norm());
  return largest;
}

}  // namespace

TEST_CASE("adaptive run: cycles of refining and merging leave a resting sheet as it was", "[run]") {
  constexpr double kNever = 1e6;  // [1/m]
  AdaptiveRun run(hanging_scene(), {kNever, 2});
  for (int step = 0; step < 600; ++step) REQUIRE(run.step().ok());
  const int n_base = run.model().n_vertices();
  const double energy = total_energy(run.model(), run.state());
  REQUIRE(energy < -0.1);  // energy of its weight [J], from pins at the origin's height
  for (const double split_curvature : {1.0, kNever, 2.0, kNever, 0.1, kNever}) {
    run.set_options({split_curvature, 2});
    for (int frame = 0; frame < 6; ++frame) {
      const Places before = places(run);
      run.adapt();
      CHECK(largest_jump(before, places(run)) < 1e-3);
      for (int step = 0; step < 2; ++step) REQUIRE(run.step().ok());
      CAPTURE(split_curvature, frame, run.model().n_vertices());
      CHECK(total_energy(run.model(), run.state()) == Approx(energy).epsilon(0.01));
    }
    if (split_curvature == kNever)
      CHECK(run.model().n_vertices() == n_base);
    else
      CHECK(run.model().n_vertices() > n_base + 50);
  }
}

TEST_CASE("adaptive run: where nothing is refined it is the simulation, to the bit", "[run]") {
  const Scene scene = hanging_scene();
  AdaptiveRun run(scene, {1e6, 2});
  Simulation simulation(scene);
  for (int step = 0; step < 20; ++step) {
    CHECK_FALSE(run.adapt());
    REQUIRE(run.step().ok());
    REQUIRE(simulation.step().ok());
  }
  CHECK(run.time() == simulation.time());
  CHECK(run.state().positions == simulation.state().positions);
  CHECK(run.state().velocities == simulation.state().velocities);
}

TEST_CASE("adaptive run: it begins where the scene starts, as the simulation does", "[run]") {
  Scene scene = hanging_scene();
  scene.method.substeps = 1;
  Simulation before(scene);
  for (int step = 0; step < 10; ++step) REQUIRE(before.step().ok());
  scene.start = StartState{before.state().positions, before.state().velocities, 0};
  AdaptiveRun run(scene, {1e6, 2});
  Simulation simulation(scene);
  CHECK(run.state().positions == simulation.state().positions);
  CHECK(run.state().velocities == before.state().velocities);
  for (int step = 0; step < 5; ++step) {
    CHECK_FALSE(run.adapt());
    REQUIRE(run.step().ok());
    REQUIRE(simulation.step().ok());
  }
  CHECK(run.state().positions == simulation.state().positions);
}

TEST_CASE("adaptive run: cloth that is not of quads is refused", "[run]") {
  Scene scene = hanging_scene();
  ParticleCloth cloth;
  cloth.positions = cloth.velocities = Positions::Zero(3, 1);
  cloth.masses = Eigen::VectorXd::Ones(1);
  scene.cloth = cloth;
  scene.pins.clear();
  CHECK_THROWS_AS(AdaptiveRun(scene, {10, 2}), InputError);
}

}  // namespace pleat
