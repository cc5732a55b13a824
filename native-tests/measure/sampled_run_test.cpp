#include "core/measure/sampled_run.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/base/check.h"
#include "native-tests/support/models.h"

using namespace pleat;

namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

Scene swinging_scene() {
  Scene scene = released_sheet_scene(3, "fine cotton");
  scene.method.solver = SolverKind::eigen;
  return scene;
}

/// A particle on a spring without weight, whose motion is a cosine.
Scene oscillator_scene(double step) {
  Scene scene;
  InlineCloth cloth;
  cloth.positions = Positions::Zero(3, 2);
  cloth.positions(0, 1) = 1.1;
  cloth.velocities = Positions::Zero(3, 2);
  cloth.masses = Eigen::VectorXd::Ones(2);
  Spring spring;
  spring.a = VertexId(0);
  spring.b = VertexId(1);
  spring.stiffness = 25;
  spring.rest_length = 1;
  cloth.springs = {spring};
  scene.cloth = cloth;
  scene.gravity = Vec3::Zero();
  PinRule pin;
  pin.where = std::vector<VertexId>{VertexId(0)};
  scene.pins = {pin};
  scene.method.stepper = StepperKind::explicit_euler;
  scene.method.step = step;
  return scene;
}

std::vector<Sample> samples_of(const Scene& scene, const std::vector<double>& times,
                               double budget) {
  SampledRun run(scene, times, SampledRun::Parts::untimed);
  while (!run.done()) run.advance(budget);
  return run.samples();
}

}  // namespace

TEST_CASE("sampled_run: a sample at the end of a step is the state", "[measure]") {
  const Scene scene = swinging_scene();
  const std::vector<Sample> samples = samples_of(scene, {0.05, 0.1}, kForever);
  Simulation simulation(scene);
  for (int s = 0; s < 3; ++s) simulation.step();
  CHECK(samples.at(0).positions == simulation.state().positions);
  for (int s = 0; s < 3; ++s) simulation.step();
  CHECK(samples.at(1).positions == simulation.state().positions);
}

TEST_CASE("sampled_run: slices do not change the samples", "[measure]") {
  const std::vector<double> times = {0.03, 0.1, 0.2};
  const std::vector<Sample> whole = samples_of(swinging_scene(), times, kForever);
  const std::vector<Sample> sliced = samples_of(swinging_scene(), times, 0);
  REQUIRE(whole.size() == sliced.size());
  for (std::size_t s = 0; s < whole.size(); ++s) CHECK(whole[s].positions == sliced[s].positions);
}

// x = 1 + 0.1 cos(5 t); the stepper's own error of first order would hide the cubic's, so the
// sample is compared with the mean of what a step of half the length gives there: both share the
// error of the stepper to first order.
TEST_CASE("sampled_run: inside a step positions follow the motion, not the chord", "[measure]") {
  const double step = 0.02;
  const double time = 10.5 * step;  // the middle of a step, where the chord is off most
  const double sample = samples_of(oscillator_scene(step), {time}, kForever).at(0).positions(0, 1);
  const double finer =
      samples_of(oscillator_scene(step / 64), {time}, kForever).at(0).positions(0, 1);
  const double exact = 1 + 0.1 * std::cos(5 * time);
  const double stepper_error = 0.1 * 5 * step / 2;  // half a step late or early
  CHECK(finer == Approx(exact).margin(stepper_error / 32));
  CHECK(sample == Approx(exact).margin(stepper_error));
}

TEST_CASE("sampled_run: the first step is not on the clock", "[measure]") {
  const double step = swinging_scene().method.step;
  SampledRun one(swinging_scene(), {step}, SampledRun::Parts::timed);
  one.advance(kForever);
  CHECK(one.timed_duration() == 0);
  CHECK(one.timed_seconds() == 0);
  SampledRun three(swinging_scene(), {3 * step}, SampledRun::Parts::timed);
  three.advance(kForever);
  CHECK(three.timed_duration() == Approx(2 * step));
}

TEST_CASE("sampled_run: a run that the numbers end has a status and no more samples", "[measure]") {
  Scene scene = oscillator_scene(1.0 / 60);
  std::get<InlineCloth>(scene.cloth).velocities(0, 1) = 1e308;
  SampledRun run(scene, {0.5, 1.0}, SampledRun::Parts::untimed);
  run.advance(kForever);
  CHECK(run.done());
  CHECK(run.failed());
  CHECK(run.report().status == SolveStatus::not_finite);
  CHECK(run.samples().empty());
}

TEST_CASE("sampled_run: times have to ascend", "[measure]") {
  CHECK_THROWS_AS(SampledRun(swinging_scene(), {}, SampledRun::Parts::untimed), ContractError);
  CHECK_THROWS_AS(SampledRun(swinging_scene(), {0.2, 0.1}, SampledRun::Parts::untimed),
                  ContractError);
}
