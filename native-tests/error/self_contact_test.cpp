#include <catch2/catch.hpp>

#include "core/base/random.h"
#include "core/dynamics/stepper_table.h"
#include "core/error/self_crossings.h"
#include "core/run/simulation.h"
#include "native-tests/support/cloth.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

constexpr int kCells = 6;

/// A sheet of 0.4 m that hangs straight down from two corners, which come together.
Scene gathered_scene() {
  Scene scene = released_sheet_scene(kCells, "fine cotton");
  change_cloth<SheetCloth>(scene, [](SheetCloth& sheet) {
    sheet.shape.width = 0.4;
    sheet.shape.height = 0.4;
    sheet.shape.origin = {0, 1, 0};
    sheet.shape.warp_direction = {0, -1, 0};
    sheet.shape.weft_direction = {1, 0, 0};
  });
  scene.pins.clear();
  scene.pins.push_back({PinBox{{-0.01, 0.99, -0.01}, {0.01, 1.01, 0.01}}, {}});
  Motion together;
  together.kind = Motion::Kind::ease;
  together.offset = {-0.38, 0, 0.002};
  together.time_end = 0.5;
  scene.pins.push_back({PinBox{{0.39, 0.99, -0.01}, {0.41, 1.01, 0.01}}, together});
  return scene;
}

/// A sheet that stands on a floor and folds up.
Scene standing_scene() {
  Scene scene = gathered_scene();
  scene.pins.clear();
  change_cloth<SheetCloth>(scene, [](SheetCloth& sheet) { sheet.shape.origin = {0, 0.42, 0.01}; });
  scene.gravity = {0.3, -9.8, 0.5};
  scene.colliders.push_back({Plane{}, {}, 0.3});
  return scene;
}

/// Threads soft enough that methods with a bound of stability take few substeps.
void take(const StepperType& type, Scene& scene) {
  scene.method = type.usual_method();
  scene.method.step = 1.0 / 60;
  if (!type.has_stability_bound) return;
  scene.method.substeps = kStableSubsteps;
  scene.fabric.stretch_warp = scene.fabric.stretch_weft = 50;
  scene.fabric.shear = 5;
  scene.fabric.damping_ratio = 0;
}

SelfCrossings referee_of(const Simulation& simulation) {
  return {simulation.triangles(), simulation.rest_positions(), simulation.model().hanging};
}

}  // namespace

TEST_CASE("self_contact: no step of any stepper ends with cloth through cloth", "[error]") {
  const bool is_gathered = GENERATE(true, false);
  CAPTURE(is_gathered);
  int n_touched = 0;
  for (const StepperType* type : standard_steppers()) {
    CAPTURE(type->name);
    Scene scene = is_gathered ? gathered_scene() : standing_scene();
    take(*type, scene);
    scene.self_contact.emplace();
    Simulation simulation(scene);
    SelfCrossings referee = referee_of(simulation);
    int most_touching = 0;
    for (int step = 0; step < 60; ++step) {
      const SolveReport report = simulation.step();
      REQUIRE_FALSE(report.ends_run());
      REQUIRE(referee.count(simulation.state().positions) == 0);
      most_touching = std::max(most_touching, simulation.stepper().cloth_contact()->n_touching());
    }
    n_touched += most_touching > 0 ? 1 : 0;
  }
  CHECK(n_touched >= 5);  // else the scene tries nothing
}

TEST_CASE("self_contact: without it the same cloth passes through itself", "[error]") {
  Scene scene = gathered_scene();
  take(*find_stepper(standard_steppers(), "implicit"), scene);
  Simulation simulation(scene);
  CHECK(simulation.stepper().cloth_contact() == nullptr);
  SelfCrossings referee = referee_of(simulation);
  std::int64_t most = 0;
  for (int step = 0; step < 60; ++step) {
    simulation.step();
    most = std::max(most, referee.count(simulation.state().positions));
  }
  CHECK(most > 0);
}

TEST_CASE("self_contact: cloth whose vertices are thrown in all directions stays whole",
          "[error]") {
  const double speed = GENERATE(3.0, 100.0);
  CAPTURE(speed);
  for (const char* name : {"implicit", "xpbd", "explicit"}) {
    CAPTURE(name);
    Scene scene = gathered_scene();
    scene.pins.clear();
    take(*find_stepper(standard_steppers(), name), scene);
    scene.self_contact.emplace();
    Simulation simulation(scene);
    SelfCrossings referee = referee_of(simulation);
    State state = simulation.state();
    Random random(17);
    for (int i = 0; i < state.velocities.cols(); ++i)
      for (int k = 0; k < 3; ++k) state.velocities(k, i) = random.uniform(-speed, speed);
    simulation.go_on_from(state, 0);
    for (int step = 0; step < 20; ++step) {
      if (simulation.step().ends_run()) break;  // it diverged, and said so
      REQUIRE(referee.count(simulation.state().positions) == 0);
    }
  }
}

}  // namespace pleat
