#include "core/error/restarts.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/error/mesh_sampling.h"
#include "core/model/momentum.h"
#include "core/run/simulation.h"
#include "native-tests/support/graded_sheets.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

Scene canvas_at_level(int level) {
  Scene scene = released_sheet_scene(4, "canvas");
  scene.level = level;
  scene.method.solver = SolverKind::eigen;
  return scene;
}

RestartOptions short_options() {
  RestartOptions options;
  options.begin = 0.2;
  options.after = 0.1;
  options.duration = 0.6;
  return options;
}

}  // namespace

TEST_CASE("restarts: a state that is sampled keeps its linear momentum", "[error]") {
  // The parts of a velocity that is linear along the sheet add up to its integral.
  const bool is_graded = GENERATE(false, true);
  Scene fine = canvas_at_level(2);
  fine.pins.clear();
  Scene coarse = canvas_at_level(0);
  coarse.pins.clear();
  Simulation simulation(fine);
  if (is_graded) coarse.plan = patchy_plan(*base_quads(coarse));
  Simulation restarted(coarse);
  State state = simulation.state();
  state.velocities = state.positions;
  state.velocities.row(1).array() += 0.7;
  const MeshSampling sampling(*restarted.mesh(), *simulation.mesh());
  restarted.go_on_from({sampling.sampled(state.positions), sampling.sampled(state.velocities)}, 1);
  const Vec3 own = momentum(restarted.model(), restarted.state());
  const Vec3 theirs = momentum(simulation.model(), state);
  CHECK((own - theirs).norm() < 1e-12 * theirs.norm());
  CHECK(own.norm() > 0.1);
}

TEST_CASE("restarts: the same mesh is right, a coarser one the less the coarser", "[error]") {
  const auto errors =
      restart_errors(canvas_at_level(2),
                     {canvas_at_level(2), canvas_at_level(1), canvas_at_level(0)}, short_options());
  REQUIRE(errors.size() == 3);
  for (const auto& of_mesh : errors) REQUIRE(of_mesh.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(errors[0][k] < 1e-8);
    CHECK(errors[1][k] > 1e-6);
    CHECK(errors[2][k] > 1.5 * errors[1][k]);
  }
}

TEST_CASE("restarts: what cannot be restarted is refused", "[error]") {
  RestartOptions options = short_options();
  options.after = 0.2;
  CHECK_THROWS_AS(restart_errors(canvas_at_level(1), {}, options), InputError);
  options = short_options();
  options.duration = 0.25;
  CHECK_THROWS_AS(restart_errors(canvas_at_level(1), {}, options), InputError);
  Scene other = canvas_at_level(0);
  other.method.step /= 2;
  CHECK_THROWS_AS(restart_errors(canvas_at_level(1), {other}, short_options()), InputError);
}

}  // namespace pleat
