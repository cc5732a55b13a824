// The exact method at rest against closed forms that share no code with it.
#include <catch2/catch.hpp>
#include <cmath>
#include <utility>

#include "core/dynamics/stepper_table.h"
#include "core/reference/closed_form_reference.h"
#include "core/run/simulation.h"

namespace pleat {
namespace {

/// Positions at rest, found by newton from the rest shape.
Positions at_rest(Scene scene) {
  scene.method = MethodOptions{};
  scene.method.stepper = &steppers::kNewton;
  scene.method.rule = NewtonRule::equilibrium;
  scene.method.solver = SolverKind::eigen;
  scene.method.tolerance = kNewtonTolerance;
  Simulation simulation(scene);
  const SolveReport report = simulation.step();
  CAPTURE(report.message, report.iterations);
  REQUIRE(report.ok());
  return simulation.state().positions;
}

/// Positions that a method comes to in this time [s].
Positions after(Scene scene, const MethodOptions& method, double duration) {
  scene.method = method;
  Simulation simulation(scene);
  while (simulation.time() < duration) REQUIRE(simulation.step().ok());
  return simulation.state().positions;
}

Positions expected(const Scene& scene) {
  const std::vector<double> times{1};
  return closed_form_reference(scene, times).samples[0].positions;
}

Scene hanging_strip(Elasticity elasticity, int rows) {
  SheetShape shape;
  shape.width = 0.25;
  shape.rows = rows;
  shape.columns = rows / 4;
  Scene scene;
  scene.cloth = SheetCloth(shape);
  scene.fabric.areal_density = 0.2;
  scene.fabric.stretch_warp = 20;  // so soft that it gets a twentieth longer
  scene.fabric.stretch_weft = 20;
  scene.fabric.shear = 0;
  scene.model.elasticity = elasticity;
  scene.model.bending = BendingModel::none;
  scene.pins = {{"upper_edge", {}}};
  return scene;
}

/// A strip of so many rows behind its clamp, which a load of rho g L^3/B bends.
Scene cantilever(Elasticity elasticity, int rows, double load) {
  constexpr double kLength = 0.2;  // [m]
  SheetShape shape;
  shape.rows = rows + 1;
  shape.columns = rows / 10;
  shape.height = kLength * shape.rows / rows;
  shape.width = kLength / 10;
  shape.warp_direction = {1, 0, 0};
  shape.weft_direction = {0, 0, 1};
  Scene scene;
  scene.cloth = SheetCloth(shape);
  scene.fabric.areal_density = 0.1;
  scene.fabric.stretch_warp = 4000;
  scene.fabric.stretch_weft = 4000;
  scene.fabric.shear = 1000;
  scene.fabric.bend_warp = 0.1 * 9.81 * std::pow(kLength, 3) / load;
  scene.fabric.bend_weft = scene.fabric.bend_warp;
  scene.model.elasticity = elasticity;
  scene.model.bending =
      elasticity == Elasticity::springs ? BendingModel::quadratic : BendingModel::fitted;
  std::vector<VertexId> held;
  for (int i = 0; i < 2 * (shape.columns + 1); ++i) held.emplace_back(i);
  scene.pins = {{held, {}}};
  return scene;
}

/// How far the tip is from where it should be, in shares of the length.
double tip_error(Elasticity elasticity, int rows, double load) {
  const Scene scene = cantilever(elasticity, rows, load);
  const Positions found = at_rest(scene);
  return (found - expected(scene)).rightCols<1>().norm() / 0.2;
}

}  // namespace

TEST_CASE("statics: a strip hangs as its closed form says", "[reference]") {
  const auto elasticity = GENERATE(Elasticity::springs, Elasticity::membrane);
  const auto error = [&](int rows) {
    const Scene scene = hanging_strip(elasticity, rows);
    return (at_rest(scene) - expected(scene)).row(1).cwiseAbs().maxCoeff();
  };
  const double coarse = error(8);
  const double fine = error(16);
  CAPTURE(static_cast<int>(elasticity), coarse, fine);
  // Springs with half a node's mass at the end are exact; a membrane is of second order.
  if (elasticity == Elasticity::springs)
    CHECK(fine < 1e-9);
  else
    CHECK(std::log2(coarse / fine) == Approx(2).margin(0.3));
  CHECK(fine < 1e-4);
}

TEST_CASE("statics: a cantilever of springs bends as the heavy elastica does", "[reference]") {
  const double load = GENERATE(1.0, 10.0);
  const double coarse = tip_error(Elasticity::springs, 10, load);
  const double fine = tip_error(Elasticity::springs, 20, load);
  CAPTURE(load, coarse, fine);
  CHECK(std::log2(coarse / fine) == Approx(2).margin(0.4));
  CHECK(fine < 0.01);
}

TEST_CASE("statics: a cantilever of a membrane does so to first order", "[reference]") {
  const double load = GENERATE(1.0, 10.0);
  const double coarse = tip_error(Elasticity::membrane, 10, load);
  const double fine = tip_error(Elasticity::membrane, 20, load);
  CAPTURE(load, coarse, fine);
  CHECK(std::log2(coarse / fine) > 0.7);
  CHECK(fine < 0.02);
}

TEST_CASE("statics: a cantilever comes to the heavy elastica with position-based steps",
          "[reference]") {
  const Scene scene = cantilever(Elasticity::springs, 20, 8);  // two bending lengths
  Scene in_air = scene;
  in_air.air.emplace();
  // The threads of pbd and hpbd are longer than at rest by some percent.
  const auto [stepper, tolerance] =
      GENERATE(std::pair(&steppers::kXpbd, 0.01), std::pair(&steppers::kMultigrid, 0.01),
               std::pair(&steppers::kHpbd, 0.05), std::pair(&steppers::kPbd, 0.08));
  CAPTURE(stepper->name);
  const Positions found = after(in_air, stepper->usual_method(), 30);
  CHECK((found - expected(scene)).rightCols<1>().norm() < tolerance * 0.2);
}

}  // namespace pleat
