#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/dynamics/stepper_table.h"
#include "core/run/simulation.h"
#include "core/scene/format/solid_section.h"
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

/// Height above the surface; of a rounded cone, of one radius [m].
double height(const SolidShape& solid, const Vec3& place) {
  if (const auto* ball = std::get_if<Sphere>(&solid))
    return (place - ball->centre).norm() - ball->radius;
  if (const auto* plane = std::get_if<Plane>(&solid))
    return plane->normal.dot(place - plane->point);
  const auto& capsule = std::get<RoundedCone>(solid);
  const Vec3 axis = capsule.centre_b - capsule.centre_a;
  const double share = (place - capsule.centre_a).dot(axis) / axis.squaredNorm();
  return (place - capsule.centre_a - std::clamp(share, 0.0, 1.0) * axis).norm() - capsule.radius_a;
}

}  // namespace

TEST_CASE("contact: a sheet shot at a solid at 50 m/s never enters it", "[run]") {
  const Vec3 centre(0.05, 0, 0.02);
  const Vec3 half_axis(0.2, 0, 0.1);
  const auto solid = GENERATE_COPY(
      SolidShape(Plane{}), SolidShape(Sphere{centre, kRadius}),
      SolidShape(RoundedCone{centre - half_axis, centre + half_axis, kRadius, kRadius}));
  CAPTURE(word_for(solid));
  for (const MethodOptions& method : everyday_methods()) {
    CAPTURE(method.stepper->name);
    Scene scene = falling_scene(method, kRadius + 0.5);
    change_cloth<SheetCloth>(scene, [](SheetCloth& sheet) {
      sheet.initial_velocity = {0, -50, 0};
    });
    scene.colliders.push_back({solid, {}, 0.3});
    Simulation simulation(scene);
    for (int s = 0; s < 30; ++s) {
      const SolveReport report = simulation.step();
      REQUIRE((report.ok() || report.status == SolveStatus::not_converged));
      const Positions& x = simulation.state().positions;
      const double rounding = 1e-6;  // [m], of xpbd's float32
      double least = std::numeric_limits<double>::infinity();
      for (int i = 0; i < x.cols(); ++i) least = std::min(least, height(solid, x.col(i)));
      REQUIRE(least > -rounding);
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
