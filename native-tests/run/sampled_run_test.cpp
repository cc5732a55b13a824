#include "core/run/sampled_run.h"

#include <catch2/catch.hpp>
#include <limits>

#include "core/base/check.h"
#include "core/scene/cloth/particle_cloth.h"
#include "native-tests/support/models.h"

using namespace pleat;

namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

Scene swinging_scene() {
  Scene scene = released_sheet_scene(3, "fine cotton");
  scene.method.solver = SolverKind::eigen;
  return scene;
}

/// One particle in free fall from the origin.
Scene falling_scene(double step) {
  Scene scene;
  ParticleCloth cloth;
  cloth.positions = Positions::Zero(3, 1);
  cloth.velocities = Positions::Zero(3, 1);
  cloth.masses = Eigen::VectorXd::Ones(1);
  scene.cloth = cloth;
  scene.method.stepper = &steppers::kExplicitEuler;
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

TEST_CASE("sampled_run: a sample at the end of a step is the state", "[run]") {
  const Scene scene = swinging_scene();
  const std::vector<Sample> samples = samples_of(scene, {0.05, 0.1}, kForever);
  Simulation simulation(scene);
  for (int s = 0; s < 3; ++s) simulation.step();
  CHECK(samples.at(0).positions == simulation.state().positions);
  for (int s = 0; s < 3; ++s) simulation.step();
  CHECK(samples.at(1).positions == simulation.state().positions);
}

TEST_CASE("sampled_run: slices do not change the samples", "[run]") {
  const std::vector<double> times = {0.03, 0.1, 0.2};
  const std::vector<Sample> whole = samples_of(swinging_scene(), times, kForever);
  const std::vector<Sample> sliced = samples_of(swinging_scene(), times, 0);
  REQUIRE(whole.size() == sliced.size());
  for (std::size_t s = 0; s < whole.size(); ++s) CHECK(whole[s].positions == sliced[s].positions);
}

// A falling particle has v = -g h n and, stepped symplectically, y = -g h^2 n (n + 1)/2. In the
// middle of a step the cubic is above the chord by h (v_n - v_{n+1})/8 = g h^2/8.
TEST_CASE("sampled_run: inside a step positions follow the motion, not the chord", "[run]") {
  const double h = 0.02;
  const double g = 9.81;
  const int n = GENERATE(0, 1, 10);
  CAPTURE(n);
  const std::vector<Sample> samples = samples_of(falling_scene(h), {(n + 0.5) * h}, kForever);
  const double chord = -g * h * h * (n + 1) * (n + 1) / 2;
  CHECK(samples.at(0).positions(1, 0) == Approx(chord + g * h * h / 8).epsilon(1e-12));
}

TEST_CASE("sampled_run: the first step is not on the clock", "[run]") {
  const double step = swinging_scene().method.step;
  SampledRun one(swinging_scene(), {step}, SampledRun::Parts::timed_with_ledger);
  one.advance(kForever);
  CHECK(one.timed_duration() == 0);
  CHECK(one.timed_seconds() == 0);
  SampledRun three(swinging_scene(), {3 * step}, SampledRun::Parts::timed_with_ledger);
  three.advance(kForever);
  CHECK(three.timed_duration() == Approx(2 * step));
}

TEST_CASE("sampled_run: the ledger sees every step, and is not kept untimed", "[run]") {
  const double step = swinging_scene().method.step;
  SampledRun run(swinging_scene(), {20 * step}, SampledRun::Parts::timed_with_ledger);
  run.advance(kForever);
  Simulation simulation(swinging_scene());
  EnergyLedger ledger(simulation.model(), simulation.state());
  for (int s = 0; s < 20; ++s) {
    const State begin = simulation.state();
    simulation.step();
    ledger.record(begin, simulation.state(), simulation.time(), step);
  }
  CHECK(ledger.relative_drift() > 0);
  CHECK(run.relative_drift() == ledger.relative_drift());
  CHECK(std::isnan(
      SampledRun(swinging_scene(), {step}, SampledRun::Parts::untimed).relative_drift()));
}

TEST_CASE("sampled_run: a run that the numbers end has a status and no more samples", "[run]") {
  Scene scene = falling_scene(1.0 / 60);
  scene.gravity = Vec3(0, 1e308, 0);
  scene.method.step = 100;
  SampledRun run(scene, {150, 200}, SampledRun::Parts::untimed);
  run.advance(kForever);
  CHECK(run.done());
  CHECK(run.failed());
  CHECK(run.report().status == SolveStatus::not_finite);
  CHECK(run.samples().empty());
}

TEST_CASE("sampled_run: nonsense is seen by who looks, and a run on the clock does not look",
          "[run]") {
  Scene scene = swinging_scene();
  scene.gravity = Vec3(0, -1e6, 0);
  const auto n_warnings = [&](SampledRun::Parts parts) {
    SampledRun run(scene, {0.2}, parts);
    run.advance(kForever);
    CHECK_FALSE(run.failed());
    return run.warnings().size();
  };
  CHECK(n_warnings(SampledRun::Parts::timed_with_ledger) > 0);
  CHECK(n_warnings(SampledRun::Parts::watched) > 0);
  CHECK(n_warnings(SampledRun::Parts::untimed) == 0);
}

TEST_CASE("sampled_run: times have to ascend", "[run]") {
  CHECK_THROWS_AS(SampledRun(swinging_scene(), {}, SampledRun::Parts::untimed), ContractError);
  CHECK_THROWS_AS(SampledRun(swinging_scene(), {0.2, 0.1}, SampledRun::Parts::untimed),
                  ContractError);
}
