#include <catch2/catch.hpp>
#include <cmath>

#include "core/dynamics/stepper_table.h"
#include "core/run/simulation.h"
#include "native-tests/support/cloth.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

constexpr double kRadius = 0.3;  // radius of the ball [m]

/// A limp horizontal sheet above the origin.
Scene falling_scene(const MethodOptions& method, double height) {
  Scene scene = released_sheet_scene(8, "fine cotton");
  change_cloth<SheetCloth>(scene, [&](SheetCloth& sheet) {
    sheet.shape.origin = {-0.5, height, -0.5};
  });
  scene.pins.clear();
  scene.method = method;
  return scene;
}

}  // namespace

TEST_CASE("contact: a sheet shot at a ball or a floor at 50 m/s never enters it", "[run]") {
  const bool ball = GENERATE(true, false);
  CAPTURE(ball);
  for (const MethodOptions& method : everyday_methods()) {
    CAPTURE(method.stepper->name);
    Scene scene = falling_scene(method, kRadius + 0.5);
    change_cloth<SheetCloth>(scene, [](SheetCloth& sheet) {
      sheet.initial_velocity = {0, -50, 0};
    });
    const Sphere sphere{{0.05, 0, 0.02}, kRadius};
    if (ball)
      scene.colliders.push_back({sphere, {}, 0.3});
    else
      scene.colliders.push_back({Plane{}, {}, 0.3});
    Simulation simulation(scene);
    for (int s = 0; s < 30; ++s) {
      const SolveReport report = simulation.step();
      REQUIRE((report.ok() || report.status == SolveStatus::not_converged));
      const Positions& x = simulation.state().positions;
      const double rounding = 1e-6;  // [m], of xpbd's float32
      if (ball)
        REQUIRE((x.colwise() - sphere.centre).colwise().norm().minCoeff() > kRadius - rounding);
      else
        REQUIRE(x.row(1).minCoeff() > -rounding);
    }
  }
}

TEST_CASE("contact: cloth dropped flat on a floor comes to rest there", "[run][long]") {
  for (const MethodOptions& method : everyday_methods()) {
    CAPTURE(method.stepper->name);
    Scene scene = falling_scene(method, 0.05);
    scene.colliders.push_back({Plane{}, {}, 0.5});
    Simulation simulation(scene);
    for (int s = 0; s < 120; ++s) simulation.step();
    CHECK(simulation.state().velocities.cwiseAbs().maxCoeff() < 1e-5);
    CHECK(simulation.state().positions.row(1).maxCoeff() < 0.001);
  }
}

}  // namespace pleat
