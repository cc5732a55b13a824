#include "core/run/simulation.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/scene/cloth/particle_cloth.h"
#include "core/scene/format/scene_file.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/particle.h"

namespace pleat {
namespace {

Scene asset_scene(const char* name) { return read_scene(scene_text(name), fabric_library()); }

/// Small enough that every stepper runs it in a moment.
Scene coarse_scene(const char* name) {
  Scene scene = asset_scene(name);
  scene.level = 1;
  scene.method.solver = SolverKind::eigen;
  return scene;
}

void run(Simulation& simulation, int n_steps) {
  for (int step = 0; step < n_steps; ++step) {
    const SolveReport report = simulation.step();
    CAPTURE(step, report.message);
    REQUIRE((report.ok() || report.status == SolveStatus::not_converged));
  }
}

}  // namespace

TEST_CASE("simulation: an edge of a sheet is pinned whole, whatever the sheet's size", "[run]") {
  const double size = GENERATE(0.1, 0.7, 1.0, 4.98);
  const int cells = GENERATE(3, 7, 14);
  CAPTURE(size, cells);
  for (const char* part : {"upper_edge", "lower_edge", "left_edge", "right_edge"}) {
    Scene scene;
    SheetShape shape;
    shape.width = shape.height = size;
    shape.columns = shape.rows = cells;
    scene.cloth = SheetCloth(shape);
    scene.level = 1;
    scene.pins = {{part, {}}};
    CHECK(Simulation(scene).model().pins.size() == static_cast<std::size_t>(2 * cells + 1));
  }
}

TEST_CASE("simulation: an edge keeps its motion where it shares a corner with one at rest",
          "[run]") {
  Scene scene;
  scene.pins = {{"upper_edge", {}}, {"upper_left", {}}};
  CHECK(Simulation(scene).model().pins.size() == 2);
}

TEST_CASE("simulation: every stepper lets a free sheet fall by the sum of its steps", "[run]") {
  // All four add g h to the velocity and then h v to the position: after n substeps of h the sheet
  // is g h^2 n (n + 1) / 2 lower, and nothing stretches.
  const auto stepper = GENERATE(&steppers::kExplicitEuler, &steppers::kImplicitEuler,
                                &steppers::kProjective, &steppers::kXpbd);
  CAPTURE(stepper->name);
  Scene scene = coarse_scene("falling_sheet");
  scene.method.stepper = stepper;
  scene.method.substeps = stepper == &steppers::kExplicitEuler ? 0 : 2;
  Simulation simulation(scene);
  const int n_steps = stepper == &steppers::kExplicitEuler ? 3 : 30;
  run(simulation, n_steps);
  const double h = scene.method.step / simulation.substeps();
  const double n = static_cast<double>(n_steps) * simulation.substeps();
  const Positions fallen =
      simulation.rest_positions().colwise() - Vec3(0, kGravity * h * h * n * (n + 1) / 2, 0);
  // Rounding of the lengths times the springs' stiffness pushes light vertices about; xpbd holds
  // its positions as 32-bit floats, of 7 digits.
  const double tolerance = stepper->is_single_precision ? 1e-4 : 1e-7;
  CHECK((simulation.state().positions - fallen).cwiseAbs().maxCoeff() < tolerance);
}

TEST_CASE(
    "simulation: the hanging chain comes to rest with its links stretched by what hangs on them",
    "[run]") {
  const Scene scene = asset_scene("hanging_chain");
  const auto& chain = *scene.cloth.as<ParticleCloth>();
  Simulation simulation(scene);
  run(simulation, 1200);
  const auto n_links = static_cast<int>(chain.springs.size());
  for (int link = 1; link <= n_links; ++link) {
    const Spring& spring = chain.springs[static_cast<std::size_t>(link - 1)];
    const Positions& x = simulation.state().positions;
    const double elongation = (x.col(spring.a) - x.col(spring.b)).norm() - spring.rest_length;
    const double weight = (n_links - link + 1) * chain.masses[link] * kGravity;
    CAPTURE(link);
    // After 20 s the dampers and the stepper have taken the slowest mode (15 rad/s, 7 % of
    // critical) away.
    CHECK(elongation == Approx(weight / spring.stiffness).epsilon(1e-6));
  }
}

TEST_CASE("simulation: the spring pendulum follows the cosine", "[run]") {
  const Scene scene = asset_scene("spring_pendulum");
  const auto& pendulum = *scene.cloth.as<ParticleCloth>();
  const double mass = pendulum.masses[1];
  const double stiffness = pendulum.springs[0].stiffness;
  const double omega = std::sqrt(stiffness / mass);
  const double elongation = mass * kGravity / stiffness;
  Simulation simulation(scene);
  for (int step = 0; step < 60; ++step) {
    run(simulation, 1);
    const double expected = 1.0 - elongation * (1 - std::cos(omega * simulation.time()));
    // Symplectic Euler: first order in omega h = 0.026, plus a phase drift of (omega h)^2 / 24 per
    // radian.
    CHECK(simulation.state().positions(1, 1) == Approx(expected).margin(0.02 * elongation));
  }
}

TEST_CASE("simulation: the same scene gives the same bits, and so does a reset", "[run]") {
  const char* name = GENERATE("curtain", "tablecloth", "corners_meet");
  const auto stepper =
      GENERATE(&steppers::kImplicitEuler, &steppers::kProjective, &steppers::kXpbd);
  CAPTURE(name, stepper->name);
  Scene scene = coarse_scene(name);
  scene.method.stepper = stepper;
  scene.method.iterations = 5;
  Simulation first(scene);
  Simulation second(scene);
  run(first, 15);
  run(second, 15);
  CHECK(first.state().positions == second.state().positions);
  CHECK(first.state().velocities == second.state().velocities);
  second.grab(VertexId(20));
  second.move_grab({0.1, 0.2, 0.3});
  run(second, 3);
  second.reset();
  CHECK(second.time() == 0);
  run(second, 15);
  CHECK(first.state().positions == second.state().positions);
  CHECK(first.state().velocities == second.state().velocities);
}

TEST_CASE("simulation: the tablecloth stays out of the ball and the floor", "[run]") {
  const Scene scene = coarse_scene("tablecloth");
  const auto& ball = std::get<Sphere>(scene.colliders.at(0).shape);
  Simulation simulation(scene);
  for (int step = 0; step < 90; ++step) {
    run(simulation, 1);
    const Positions& x = simulation.state().positions;
    const double nearest = (x.colwise() - ball.centre).colwise().norm().minCoeff();
    CHECK(nearest > ball.radius);
    CHECK(x.row(1).minCoeff() > 0);
  }
}

TEST_CASE("simulation: the curtain's hooks arrive and the cloth between them folds", "[run]") {
  const Scene scene = coarse_scene("curtain");
  Simulation simulation(scene);
  run(simulation, 150);
  const Positions& x = simulation.state().positions;
  const double hook_distance = x(0, 8) - x(0, 0);
  CHECK(hook_distance == Approx(0.55 * 1.2).epsilon(1e-9));
  // Threads along weft are not compressed to the hooks' distance: they stand out in z.
  double length = 0;
  const int row = 4 * 9;  // base vertices half way down
  for (int c = 0; c < 8; ++c) length += (x.col(row + c + 1) - x.col(row + c)).norm();
  CHECK(length > 1.2 * hook_distance);
}

TEST_CASE("simulation: a hand takes the grabbed vertex where it wants it and lets go", "[run]") {
  Simulation simulation(coarse_scene("swinging_sheet"));
  const VertexId corner(80);  // lower right
  simulation.grab(corner);
  const Vec3 target = simulation.state().positions.col(corner) + Vec3(-0.05, 0.02, -0.1);
  simulation.move_grab(target);
  run(simulation, 30);
  CHECK((simulation.state().positions.col(corner) - target).norm() < 1e-9);
  simulation.release_grab();
  run(simulation, 10);
  CHECK((simulation.state().positions.col(corner) - target).norm() > 1e-3);
}

TEST_CASE("simulation: a cloth moved as a whole with its pins moves as one at rest does", "[run]") {
  const Vec3 away(0.3, 0.2, -0.1);
  Scene scene = coarse_scene("swinging_sheet");
  Simulation rested(scene), moved(scene);
  moved.start_from(rested.rest_positions().colwise() + away);
  run(rested, 10);
  run(moved, 10);
  const Positions back = moved.state().positions.colwise() - away;
  CHECK((back - rested.state().positions).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("simulation: a reset goes back to where the cloth was started from", "[run]") {
  Simulation simulation(coarse_scene("swinging_sheet"));
  const Positions start = simulation.rest_positions() * 1.1;
  simulation.start_from(start);
  run(simulation, 3);
  REQUIRE((simulation.state().positions - start).cwiseAbs().maxCoeff() > 1e-3);
  simulation.reset();
  CHECK(simulation.state().positions == start);
  CHECK(simulation.time() == 0);
}

TEST_CASE("simulation: a start needs a finite place for each vertex", "[run]") {
  Simulation simulation(coarse_scene("swinging_sheet"));
  const Positions rest = simulation.rest_positions();
  CHECK_THROWS_AS(simulation.start_from(rest.leftCols(3)), InputError);
  Positions broken = rest;
  broken(1, 2) = NAN;
  CHECK_THROWS_AS(simulation.start_from(broken), InputError);
  CHECK(simulation.state().positions == rest);
}

TEST_CASE("simulation: a change of level or fabric keeps common vertices to the bit", "[run]") {
  const int old_level = GENERATE(0, 1, 2);
  const int new_level = GENERATE(0, 1, 2);
  const char* fabric = GENERATE("fine cotton", "canvas");
  CAPTURE(old_level, new_level, fabric);
  Scene scene = coarse_scene("swinging_sheet");
  scene.level = old_level;
  Simulation old(scene);
  run(old, 3);
  scene.level = new_level;
  scene.fabric = constants(fabric_library().find(fabric), scene.bend_source);
  Simulation changed(scene);
  changed.carry_over(old);
  CHECK(changed.time() == old.time());
  const int n_common = std::min(old.model().n_vertices(), changed.model().n_vertices());
  CHECK(changed.state().positions.leftCols(n_common) == old.state().positions.leftCols(n_common));
  CHECK(changed.state().velocities.leftCols(n_common) == old.state().velocities.leftCols(n_common));
}

TEST_CASE("simulation: from a state on the way it goes on as the run that was there", "[run]") {
  Scene scene = coarse_scene("swinging_sheet");
  for (PinRule& pin : scene.pins) pin.motion = {Motion::Kind::move, Vec3(0.1, 0, 0), 0, 0.5, 0};
  Simulation whole(scene);
  run(whole, 12);
  const State state = whole.state();
  const double time = whole.time();
  run(whole, 12);
  Simulation later(scene);
  run(later, 3);  // nothing of these is left
  later.go_on_from(state, time);
  CHECK(later.time() == time);
  CHECK(later.is_disturbed());
  run(later, 12);
  CHECK(later.time() == Approx(whole.time()));
  CHECK((later.state().positions - whole.state().positions).cwiseAbs().maxCoeff() < 1e-9);
  later.reset();
  CHECK(later.time() == 0);
  CHECK(later.state().positions == Simulation(scene).state().positions);
}

TEST_CASE("simulation: a state of another cloth, or of none, is refused", "[run]") {
  Simulation simulation(coarse_scene("swinging_sheet"));
  State state = simulation.state();
  state.velocities(1, 3) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(simulation.go_on_from(state, 0), Catch::Contains("not all finite"));
  state = simulation.state();
  state.velocities.conservativeResize(3, 5);
  CHECK_THROWS_WITH(simulation.go_on_from(state, 0), Catch::Contains("vertices, got 5"));
}

}  // namespace pleat
