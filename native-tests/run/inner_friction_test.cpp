#include <catch2/catch.hpp>

#include "core/dynamics/stepper_table.h"
#include "core/run/run_ledger.h"
#include "core/run/simulation.h"
#include "core/scene/format/scene_file.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

/// A curtain that is drawn, of canvas, one of the fabrics with most friction.
Scene rubbing_scene() {
  Scene scene = read_scene(scene_text("curtain"), fabric_library());
  scene.level = 1;
  scene.fabric = constants(fabric_library().find("canvas"), BendSource::friction);
  return scene;
}

void run(Simulation& simulation, int n_steps) {
  for (int s = 0; s < n_steps; ++s) REQUIRE_FALSE(simulation.step().ends_run());
}

double stored(const Simulation& simulation) {
  return simulation.model().bend_friction->energy(simulation.state().positions);
}

void check_refused(const Scene& scene, const std::string& where, const std::string& sentence) {
  try {
    const Simulation simulation(scene);
    FAIL(where);
  } catch (const InputError& error) {
    CHECK(error.where() == where);
    CHECK(error.sentence() == sentence);
  }
}

}  // namespace

TEST_CASE("inner_friction: without a loop it is the slope alone, to the bit", "[run]") {
  Scene scene = rubbing_scene();
  scene.fabric.bend_hysteresis = 0;
  Simulation none(scene);
  scene.fabric = library_fabric("canvas");
  Simulation moving(scene);
  CHECK_FALSE(none.model().bend_friction);
  run(none, 60);
  run(moving, 60);
  CHECK(none.state().positions == moving.state().positions);
}

TEST_CASE("inner_friction: it changes the motion, the same way each time", "[run]") {
  Simulation first(rubbing_scene());
  Simulation second(rubbing_scene());
  Scene scene = rubbing_scene();
  scene.fabric = library_fabric("canvas");
  Simulation moving(scene);
  for (Simulation* simulation : {&first, &second, &moving}) run(*simulation, 60);
  CHECK(first.state().positions == second.state().positions);
  CHECK((first.state().positions - moving.state().positions).norm() > 1e-3);
  const Positions reached = first.state().positions;
  first.reset();
  CHECK(stored(first) == 0);
  run(first, 60);
  CHECK(first.state().positions == reached);
}

TEST_CASE("inner_friction: the account of a run has its loss", "[run]") {
  Simulation simulation(rubbing_scene());
  RunLedger ledger(simulation);
  for (int s = 0; s < 60; ++s) {
    run(simulation, 1);
    ledger.record_step();
  }
  const EnergyLedger& account = ledger.account();
  CHECK(account.works().bend_friction == -simulation.model().bend_friction->dissipated());
  CHECK(account.works().bend_friction < 0);
}

TEST_CASE("inner_friction: moments go on over a change of fabric, not of mesh", "[run]") {
  Simulation old(rubbing_scene());
  run(old, 20);
  REQUIRE(stored(old) > 0);
  Simulation same(rubbing_scene());
  same.carry_over(old);
  CHECK(stored(same) == stored(old));
  Scene scene = rubbing_scene();
  scene.level = 2;
  Simulation fine(scene);
  fine.carry_over(old);
  CHECK(stored(fine) == 0);
}

TEST_CASE("inner_friction: other models and the rule equilibrium refuse it", "[run]") {
  Scene scene = rubbing_scene();
  scene.model.bending = BendingModel::none;
  check_refused(scene, "/model/bending",
                "expected quadratic for friction inside the fabric, got another law");
  scene.model.elasticity = Elasticity::membrane;
  check_refused(scene, "/model/elasticity",
                "expected springs for friction inside the fabric, got a membrane");
  scene = rubbing_scene();
  scene.colliders.clear();
  scene.method = steppers::kNewton.usual_method();
  scene.method.rule = NewtonRule::equilibrium;
  check_refused(scene, "/method/rule",
                "expected backward_euler or midpoint with friction inside the fabric, whose rest "
                "depends on the way to it, got equilibrium");
  scene.method = steppers::kXpbd.usual_method();
  check_refused(
      scene, "/method/stepper",
      "expected implicit or newton for friction inside the fabric, whose moments they find "
      "with the end of a step as no other does, got xpbd");
  scene = read_scene(scene_text("spring_pendulum"), fabric_library());
  scene.fabric.bend_hysteresis = 1e-3;
  check_refused(scene, "/fabric",
                "expected no friction inside cloth of given springs, whose bending has no width");
}

}  // namespace pleat
