#include "core/run/timed_run.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/run/simulation.h"
#include "core/scene/cloth/particle_cloth.h"
#include "native-tests/support/models.h"

using namespace pleat;

namespace {

double sum(const PartTimer& parts) {
  double seconds = 0;
  for (int s = 0; s < kPartCount; ++s) seconds += parts.total(static_cast<Part>(s));
  return seconds;
}

/// One particle that a force of 1e308 N takes out of all bounds in the first step.
Scene lost_scene() {
  Scene scene;
  ParticleCloth particle;
  particle.positions = particle.velocities = Positions::Zero(3, 1);
  particle.masses = Eigen::VectorXd::Ones(1);
  scene.cloth = particle;
  scene.method.stepper = &steppers::kExplicitEuler;
  scene.method.step = 100;
  scene.gravity = Vec3(0, 1e308, 0);
  return scene;
}

}  // namespace

TEST_CASE("timed_run: it steps the cloth as the cloth steps itself", "[run]") {
  const Scene scene = released_sheet_scene(3, "fine cotton");
  Simulation by_run(scene);
  Simulation by_hand(scene);
  TimedRun run(by_run, TimedRun::Parts::timed);
  run.advance(5);
  SolveReport report;
  for (int s = 0; s < 5; ++s) report.add(by_hand.step());
  CHECK(by_run.state().positions == by_hand.state().positions);
  CHECK(run.report().iterations == report.iterations);
  CHECK(run.report().iterations > 0);
  CHECK(run.report().relative_residual == report.relative_residual);
}

TEST_CASE("timed_run: the first step is not on the clock, nor are its parts", "[run]") {
  Simulation simulation(released_sheet_scene(3, "fine cotton"));
  TimedRun run(simulation, TimedRun::Parts::timed);
  CHECK(run.advance(1) > 0);
  CHECK(run.n_timed() == 0);
  CHECK(run.seconds() == 0);
  CHECK(sum(run.parts()) == 0);
  run.advance(3);
  CHECK(run.n_timed() == 3);
  CHECK(sum(run.parts()) > 0);
  CHECK(sum(run.parts()) <= run.seconds());
  run.clear_costs();
  CHECK(run.n_timed() == 0);
  CHECK(sum(run.parts()) == 0);
  run.step();
  CHECK(run.n_timed() == 1);
}

TEST_CASE("timed_run: parts are looked at only when asked for, and while it lives", "[run]") {
  Simulation simulation(released_sheet_scene(3, "fine cotton"));
  {
    TimedRun run(simulation, TimedRun::Parts::untimed);
    run.advance(2);
    CHECK(run.n_timed() == 1);
    CHECK(sum(run.parts()) == 0);
  }
  { TimedRun run(simulation, TimedRun::Parts::timed); }
  CHECK(simulation.step().ok());  // no observer that is gone
}

TEST_CASE("timed_run: no step follows the one that ended the run", "[run]") {
  Simulation simulation(lost_scene());
  TimedRun run(simulation, TimedRun::Parts::untimed);
  run.advance(10);
  CHECK(run.has_ended());
  CHECK(run.report().status == SolveStatus::not_finite);
  CHECK(run.n_timed() == 0);
}

TEST_CASE("timed_run: a frame is a whole number of steps", "[run]") {
  CHECK(steps_of_frame(1.0 / 60, 1.0 / 60) == 1);
  CHECK(steps_of_frame(1.0 / 960, 1.0 / 30) == 32);
  CHECK(steps_of_frame(0.0166666667, 1.0 / 60) == 1);
  CHECK_THROWS_AS(steps_of_frame(0.01, 1.0 / 60), InputError);
  CHECK_THROWS_AS(steps_of_frame(1.0 / 30, 1.0 / 60), InputError);
}
