#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/dynamics/stepper_table.h"
#include "core/run/simulation.h"
#include "native-tests/support/bodies.h"
#include "native-tests/support/cloth.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

SurfaceSolid box_solid(const Vec3& centre, const Vec3& size, const Mat3& axes = Mat3::Identity()) {
  return {BoxSolid{centre, size, axes.col(0), axes.col(1)}, {}, 0.3};
}

/// A sheet of 1 m x 1 m, its corner there, that lies level and is let go.
Scene dropped_scene(int cells, const Vec3& corner) {
  Scene scene = released_sheet_scene(cells, "fine cotton");
  change_cloth<SheetCloth>(scene, [&](SheetCloth& sheet) { sheet.shape.origin = corner; });
  scene.pins.clear();
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

/// Least height above a box of points all over the cloth's faces [m].
double least_height(const Simulation& simulation, const Vec3& centre, const Vec3& size,
                    const Mat3& axes = Mat3::Identity()) {
  constexpr int kParts = 24;
  const Positions& x = simulation.state().positions;
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : simulation.triangles())
    for (int i = 0; i <= kParts; ++i)
      for (int k = 0; i + k <= kParts; ++k) {
        const Vec3 place = x.col(t[0]) + i * (x.col(t[1]) - x.col(t[0])) / kParts +
                           k * (x.col(t[2]) - x.col(t[0])) / kParts;
        least = std::min(least, height_above_box(size, axes.transpose() * (place - centre)));
      }
  return least;
}

}  // namespace

TEST_CASE("surface solids: no face of eight enters a cube of twelve, whatever the stepper",
          "[run]") {
  const Vec3 size(0.3, 0.3, 0.3);
  const Vec3 centre(0.07, 0, 0.04);
  for (const StepperType* type : standard_steppers()) {
    CAPTURE(type->name);
    Scene scene = dropped_scene(2, {-0.5, 0.2, -0.5});
    take(*type, scene);
    scene.surface_solids.push_back(box_solid(centre, size));
    Simulation simulation(scene);
    REQUIRE(simulation.triangles().size() == 8);
    int most_touching = 0;
    for (int s = 0; s < 60; ++s) {
      const SolveReport report = simulation.step();
      REQUIRE_FALSE(report.ends_run());
      REQUIRE(least_height(simulation, centre, size) > 0);
      most_touching = std::max(most_touching, simulation.stepper().cloth_contact()->n_touching());
    }
    CHECK(most_touching > 0);
  }
}

TEST_CASE("surface solids: without the cube the same cloth is where it was", "[run]") {
  Scene scene = dropped_scene(2, {-0.5, 0.2, -0.5});
  Simulation simulation(scene);
  CHECK(simulation.stepper().cloth_contact() == nullptr);
  for (int s = 0; s < 60; ++s) simulation.step();
  CHECK(simulation.state().positions.row(1).maxCoeff() < -4);
}

TEST_CASE("surface solids: a sheet at 30 m/s does not pass a box's edge", "[run]") {
  const Vec3 size(0.3, 0.3, 0.9);
  const Mat3 axes =
      Eigen::AngleAxisd(M_PI / 4, Vec3::UnitZ()).toRotationMatrix();  // an edge is uppermost
  for (const char* name : {"implicit", "projective", "xpbd", "explicit"}) {
    CAPTURE(name);
    for (int seed = 0; seed < 3; ++seed) {
      Random random(static_cast<std::uint64_t>(seed));
      const Vec3 centre(random.uniform(-0.1, 0.1), -0.6, random.uniform(-0.1, 0.1));
      Scene scene = dropped_scene(6, {-0.5, 0.2, -0.5});
      take(*find_stepper(standard_steppers(), name), scene);
      change_cloth<SheetCloth>(scene, [](SheetCloth& sheet) {
        sheet.initial_velocity = {0, -30, 0};
      });
      scene.surface_solids.push_back(box_solid(centre, size, axes));
      Simulation simulation(scene);
      for (int s = 0; s < 12; ++s) {
        if (simulation.step().ends_run()) break;  // it diverged, and said so
        REQUIRE(least_height(simulation, centre, size, axes) > 0);
      }
      CHECK(simulation.time() > 0.1);
    }
  }
}

TEST_CASE("surface solids: cloth lies on a ball's mesh as on the ball", "[run]") {
  constexpr double kRadius = 0.3;
  Scene scene = dropped_scene(14, {-0.5, kRadius + 0.01, -0.5});
  scene.method.substeps = 4;
  Scene exact = scene;
  exact.colliders.push_back({Sphere{{0, 0, 0}, kRadius}, {}, 1});
  const BodySurface ball = ball_body(kRadius, 4);
  scene.surface_solids.push_back({MeshSolid{ball.places, ball.triangles, {}}, {}, 1});
  Simulation on_mesh(scene);
  Simulation on_ball(exact);
  for (int s = 0; s < 24; ++s) {
    on_mesh.step();
    on_ball.step();
  }
  const Positions& x = on_mesh.state().positions;
  const Positions& y = on_ball.state().positions;
  // The ball holds vertices 4 mm off, so that no flat face cuts it; faces of the mesh need not.
  CHECK(std::sqrt((x - y).squaredNorm() / static_cast<double>(x.cols())) < 0.03);
  double sum = 0;
  int n_lying = 0;
  for (int i = 0; i < x.cols(); ++i) {
    if (y.col(i).norm() > kRadius + 0.01) continue;
    sum += std::abs(x.col(i).norm() - y.col(i).norm());
    ++n_lying;
  }
  REQUIRE(n_lying > 20);
  CHECK(sum / n_lying < 0.01);
}

TEST_CASE("surface solids: beside self-contact both hold", "[run]") {
  const Vec3 size(0.3, 0.3, 0.3);
  const Vec3 centre(0, 0, 0);
  Scene scene = dropped_scene(6, {-0.5, 0.2, -0.5});
  scene.self_contact.emplace();
  scene.surface_solids.push_back(box_solid(centre, size));
  Simulation simulation(scene);
  for (int s = 0; s < 60; ++s) {
    REQUIRE_FALSE(simulation.step().ends_run());
    REQUIRE(least_height(simulation, centre, size) > 0);
  }
  CHECK(simulation.state().positions.row(1).maxCoeff() > 0.15);
}

TEST_CASE("surface solids: cloth that starts in one is refused with its place", "[run]") {
  Scene scene = dropped_scene(4, {-0.5, 0, -0.5});
  scene.surface_solids.push_back(box_solid({0, 0, 0}, {0.3, 0.3, 0.3}));
  CHECK_THROWS_WITH(Simulation(scene),
                    "/world/colliders: expected cloth that starts off boxes and meshes, got 1 "
                    "vertices inside of one, the deepest vertex 12 by 150 mm at (0, 0, 0) m");
}

TEST_CASE("surface solids: cloth without a thickness rests off a box, and may not begin on it",
          "[run]") {
  const Vec3 size(0.3, 0.3, 0.3);
  Scene scene = dropped_scene(4, {-0.5, 0.15, -0.5});
  scene.fabric.thickness = 0;
  scene.surface_solids.push_back(box_solid({0, 0, 0}, size));
  CHECK_THROWS_WITH(Simulation(scene), Catch::Contains("cloth that touches the surface of one"));
  change_cloth<SheetCloth>(scene, [](SheetCloth& sheet) { sheet.shape.origin.y() = 0.16; });
  Simulation simulation(scene);
  for (int s = 0; s < 30; ++s) {
    REQUIRE_FALSE(simulation.step().ends_run());
    REQUIRE(least_height(simulation, {0, 0, 0}, size) > 0);
  }
}

TEST_CASE("surface solids: a run on a box is the same each time, and after a reset", "[run]") {
  Scene scene = dropped_scene(4, {-0.5, 0.2, -0.5});
  scene.surface_solids.push_back(box_solid({0.1, 0, 0.05}, {0.3, 0.3, 0.3}));
  scene.surface_solids[0].motion.kind = Motion::Kind::oscillate;
  scene.surface_solids[0].motion.offset = {0, 0.05, 0};
  scene.surface_solids[0].motion.frequency = 2;
  Simulation first(scene);
  Simulation second(scene);
  for (int s = 0; s < 10; ++s) second.step();
  second.reset();
  for (int s = 0; s < 40; ++s) {
    first.step();
    second.step();
  }
  CHECK(first.state().positions == second.state().positions);
}

}  // namespace pleat
