#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/dynamics/stepper_table.h"
#include "core/run/simulation.h"
#include "core/scene/cloth/particle_cloth.h"
#include "native-tests/support/cloth.h"
#include "native-tests/support/graded_sheets.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

constexpr int kCells = 6;
constexpr VertexId kLowerCorner{kCells * (kCells + 1)};

/// Hanging from its upper edge, with any of the steppers.
Scene hanging_scene(const MethodOptions& method) {
  Scene scene = released_sheet_scene(kCells, "fine cotton");
  change_cloth<SheetCloth>(scene, [](SheetCloth& sheet) {
    sheet.shape.warp_direction = {0, -1, 0};
  });
  scene.method = method;
  return scene;
}

}  // namespace

TEST_CASE("hand: what it holds is at its target after every step, and keeps its speed on release",
          "[run]") {
  const Vec3 velocity(0.3, 0.1, 0.6);  // velocity of the hand [m/s]
  for (const MethodOptions& method : everyday_methods()) {
    CAPTURE(method.stepper->name);
    Simulation simulation(hanging_scene(method));
    for (int s = 0; s < 5; ++s) simulation.step();
    simulation.grab(kLowerCorner);
    const Vec3 begin = simulation.state().positions.col(kLowerCorner.value);
    for (int s = 1; s <= 10; ++s) {
      const Vec3 target = begin + s * method.step * velocity;
      simulation.move_grab(target);
      REQUIRE(simulation.step().ok());
      CHECK((simulation.state().positions.col(kLowerCorner.value) - target).norm() < 1e-12);
    }
    simulation.release_grab();
    CHECK_FALSE(simulation.is_grabbed());
    CHECK((simulation.state().velocities.col(kLowerCorner.value) - velocity).norm() < 1e-8);
  }
}

TEST_CASE("hand: a vertex that hangs is at its target too, between its parents", "[run]") {
  const Vec3 velocity(0.3, 0.1, 0.6);  // velocity of the hand [m/s]
  for (const MethodOptions& method : everyday_methods()) {
    CAPTURE(method.stepper->name);
    Scene scene = hanging_scene(method);
    scene.plan = patchy_plan(*base_quads(scene));
    Simulation simulation(scene);
    const HangingVertex held = simulation.model().hanging.back();
    for (const Pin& pin : simulation.model().pins)
      for (const VertexId parent : held.parents) REQUIRE(pin.vertex != parent);
    simulation.grab(held.vertex);
    const auto place = [&](VertexId v) { return Vec3(simulation.state().positions.col(v)); };
    const Vec3 begin = place(held.vertex);
    for (int s = 1; s <= 10; ++s) {
      const Vec3 target = begin + s * method.step * velocity;
      simulation.move_grab(target);
      REQUIRE(simulation.step().ok());
      CHECK((place(held.vertex) - target).norm() < 1e-12);
      CHECK((place(held.parents[0]) + place(held.parents[1]) - 2 * target).norm() < 1e-12);
    }
    const std::size_t n_held = simulation.model().pins.size();
    simulation.release_grab();
    CHECK(simulation.model().pins.size() < n_held);
    CHECK((simulation.state().velocities.col(held.parents[0]) - velocity).norm() < 1e-8);
  }
}

TEST_CASE("hand: a target that is not finite is ignored", "[run]") {
  Simulation simulation(hanging_scene(everyday_methods()[1]));
  simulation.grab(kLowerCorner);
  const Vec3 place = simulation.state().positions.col(kLowerCorner.value);
  simulation.move_grab(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  simulation.move_grab(Vec3::Constant(std::numeric_limits<double>::infinity()));
  REQUIRE(simulation.step().ok());
  CHECK((simulation.state().positions.col(kLowerCorner.value) - place).norm() < 1e-12);
}

TEST_CASE("hand: a pinned vertex stays at its pin", "[run]") {
  for (const MethodOptions& method : everyday_methods()) {
    CAPTURE(method.stepper->name);
    Simulation simulation(hanging_scene(method));
    const Vec3 place = simulation.state().positions.col(2);
    simulation.grab(VertexId(2));
    simulation.move_grab(place + Vec3(0, 0, 1));
    for (int s = 0; s < 5; ++s) REQUIRE(simulation.step().ok());
    CHECK(simulation.state().positions.col(2) == place);
    simulation.release_grab();
    REQUIRE(simulation.step().ok());
  }
}

TEST_CASE("simulation: after its end it says the same at every step and does not move", "[run]") {
  // A mass on a spring so stiff that an overflow follows from the first step.
  ParticleCloth particles;
  particles.positions = Positions::Zero(3, 2);
  particles.positions(0, 1) = 1e200;
  particles.velocities = Positions::Zero(3, 2);
  particles.masses = Eigen::VectorXd::Constant(2, 1e-200);
  particles.springs = {{VertexId(0), VertexId(1), 1, 1, 0, SpringKind::other}};
  Scene scene;
  scene.cloth = particles;
  scene.method = everyday_methods()[1];
  Simulation simulation(scene);
  const SolveReport first = simulation.step();
  CAPTURE(name(first.status), first.message);
  REQUIRE_FALSE(first.ok());
  REQUIRE(first.status != SolveStatus::not_converged);
  const State state = simulation.state();
  const SolveReport second = simulation.step();
  CHECK(second.status == first.status);
  CHECK(second.message == first.message);
  CHECK(simulation.state().positions == state.positions);
  CHECK(simulation.n_steps() == 0);
}

}  // namespace pleat
