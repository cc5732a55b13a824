#include "core/run/carry_over.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "core/dynamics/stepper_table.h"
#include "core/model/elasticity.h"
#include "core/run/simulation.h"
#include "core/scene/format/scene_file.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

QuadMesh refined(int levels) {
  QuadMesh mesh = sheet_with_aspect(4, 3, 1.2);
  mesh.refine_uniformly(levels);
  return mesh;
}

/// Bent both ways and twisted; of second degree along every mesh line.
Positions saddle(const QuadMesh& mesh) {
  Positions x(3, mesh.n_vertices());
  for (int i = 0; i < mesh.n_vertices(); ++i) {
    const double u = mesh.rest_coordinates()(0, i);
    const double v = mesh.rest_coordinates()(1, i);
    x.col(i) << u, v + 0.1 * u * v, 0.3 * u * u - 0.2 * v * v + 0.5 * u * v;
  }
  return x;
}

MethodOptions method(const StepperType* stepper) {
  for (const MethodOptions& options : everyday_methods())
    if (options.stepper == stepper) return options;
  return {};
}

Scene moving_scene(const std::string& name, const StepperType* stepper, int level,
                   const std::string& fabric) {
  Scene scene = read_scene(scene_text(name), fabric_library());
  scene.level = level;
  scene.fabric = constants(fabric_library().find(fabric), scene.bend_source);
  scene.method = method(stepper);
  if (stepper == &steppers::kProjective) scene.method.substeps = 4;  // less sluggish
  return scene;
}

double largest_speed(const Simulation& simulation) {
  return simulation.state().velocities.colwise().norm().maxCoeff();
}

}  // namespace

TEST_CASE("carry_over: refinement keeps a surface of second degree exactly", "[run]") {
  const int old_level = GENERATE(0, 1);
  const int new_level = GENERATE(1, 2, 3);
  CAPTURE(old_level, new_level);
  const QuadMesh coarse = refined(old_level);
  const QuadMesh fine = refined(new_level);
  const State state{saddle(coarse), 2 * saddle(coarse)};
  const ClothModel model = sheet_model(coarse, soft_fabric());
  const State carried = carried_state({coarse, model, state}, fine);
  CHECK((carried.positions - saddle(fine)).cwiseAbs().maxCoeff() < 1e-14);
  CHECK((carried.velocities - 2 * saddle(fine)).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("carry_over: vertices of both meshes keep their bits, at any levels and fabrics",
          "[run]") {
  const int old_level = GENERATE(0, 1, 2, 3);
  const int new_level = GENERATE(0, 1, 2, 3);
  CAPTURE(old_level, new_level);
  Random random(1);
  const QuadMesh coarse = refined(old_level);
  const QuadMesh fine = refined(new_level);
  const State state{shaken(coarse.rest_positions(), 0.1, random),
                    shaken(coarse.rest_positions(), 1, random)};
  const ClothModel model = sheet_model(coarse, library_fabric("canvas"));
  const State carried = carried_state({coarse, model, state}, fine);
  const int n = std::min(coarse.n_vertices(), fine.n_vertices());
  CHECK(carried.positions.leftCols(n) == state.positions.leftCols(n));
  CHECK(carried.velocities.leftCols(n) == state.velocities.leftCols(n));
  CHECK(carried.positions.allFinite());
}

TEST_CASE("carry_over: uniform tension goes on per mass in every mesh and fabric", "[run]") {
  const int old_level = GENERATE(0, 2);
  const int new_level = GENERATE(0, 1, 3);
  const std::string fabric = GENERATE("spandex", "canvas", "leather");
  CAPTURE(old_level, new_level, fabric);
  const QuadMesh coarse = refined(old_level);
  const QuadMesh fine = refined(new_level);
  ClothModel old_model = sheet_model(coarse, library_fabric("fine cotton"));
  old_model.gravity = {0, -9.81, 0};
  ClothModel fresh_model = sheet_model(fine, library_fabric(fabric));
  const State old_state{1.0001 * coarse.rest_positions(), Positions::Zero(3, coarse.n_vertices())};
  const MovingSheet old{coarse, old_model, old_state};
  const State fresh_state = carried_state(old, fine);
  const std::vector<double> lengths = carried_rest_lengths(old, {fine, fresh_model, fresh_state});
  for (std::size_t s = 0; s < lengths.size(); ++s) fresh_model.springs[s].rest_length = lengths[s];
  // Force on the upper edge, along warp and per mass of the sheet.
  const auto edge_force = [](const QuadMesh& mesh, const ClothModel& model, const Positions& x) {
    Positions forces = Positions::Zero(3, x.cols());
    add_elastic_forces(model, x, forces);
    double sum = 0;
    for (int i = 0; i < mesh.n_vertices(); ++i)
      if (mesh.rest_coordinates()(0, i) == 0) sum += forces(1, i);
    return sum / model.masses.sum();
  };
  // A corner sees one diagonal alone and takes a shear of G/K of the tension from it.
  CHECK(edge_force(fine, fresh_model, fresh_state.positions) ==
        Approx(edge_force(coarse, old_model, old_state.positions)).epsilon(0.01));
}

TEST_CASE("carry_over: stretch beyond what the sheet's weight explains is no force", "[run]") {
  const QuadMesh mesh = refined(1);
  ClothModel old_model = sheet_model(mesh, library_fabric("canvas"));
  old_model.gravity = {0, -9.81, 0};
  const ClothModel fresh_model = sheet_model(mesh, library_fabric("spandex"));
  const State state{1.02 * mesh.rest_positions(), Positions::Zero(3, mesh.n_vertices())};
  const std::vector<double> lengths =
      carried_rest_lengths({mesh, old_model, state}, {mesh, fresh_model, state});
  // Spandex strains by weight * diagonal / K at most, about 3 %; canvas' 2 % would ask for 100 %.
  for (std::size_t s = 0; s < lengths.size(); ++s) {
    const Spring& spring = fresh_model.springs[s];
    const double length =
        (state.positions.col(spring.a.value) - state.positions.col(spring.b.value)).norm();
    CHECK(length - lengths[s] < 0.05 * spring.rest_length);
  }
}

TEST_CASE("carry_over: compression does not go on in another mesh", "[run]") {
  const QuadMesh coarse = refined(1);
  const QuadMesh fine = refined(2);
  const ClothModel model = sheet_model(coarse, library_fabric("canvas"));
  const State state{0.7 * coarse.rest_positions(), Positions::Zero(3, coarse.n_vertices())};
  ClothModel fresh_model = sheet_model(fine, library_fabric("silk"));
  const MovingSheet old{coarse, model, state};
  const State fresh_state = carried_state(old, fine);
  const std::vector<double> lengths = carried_rest_lengths(old, {fine, fresh_model, fresh_state});
  for (std::size_t s = 0; s < lengths.size(); ++s) fresh_model.springs[s].rest_length = lengths[s];
  Positions forces = Positions::Zero(3, fine.n_vertices());
  fresh_model.bends.clear();
  add_elastic_forces(fresh_model, fresh_state.positions, forces);
  CHECK(forces.cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("carry_over: in another fabric on the same mesh every spring pulls as it did per mass",
          "[run]") {
  const char* fabric = GENERATE("canvas", "spandex", "leather");
  CAPTURE(fabric);
  Random random(3);
  const QuadMesh mesh = refined(1);
  ClothModel model = sheet_model(mesh, library_fabric("fine cotton"));
  model.gravity = {0, -9.81, 0};
  ClothModel fresh_model = sheet_model(mesh, library_fabric(fabric));
  // Strains that the sheet's weight explains, of both signs.
  const State state{shaken(mesh.rest_positions(), 2e-6, random),
                    Positions::Zero(3, mesh.n_vertices())};
  const std::vector<double> lengths =
      carried_rest_lengths({mesh, model, state}, {mesh, fresh_model, state});
  for (std::size_t s = 0; s < lengths.size(); ++s) fresh_model.springs[s].rest_length = lengths[s];
  const auto accelerations = [&](ClothModel& of) {
    of.bends.clear();
    Positions forces = Positions::Zero(3, mesh.n_vertices());
    add_elastic_forces(of, state.positions, forces);
    return Positions(forces * of.masses.cwiseInverse().asDiagonal());
  };
  const Positions before = accelerations(model);
  CHECK((accelerations(fresh_model) - before).cwiseAbs().maxCoeff() <
        1e-6 * before.cwiseAbs().maxCoeff());
}

TEST_CASE("carry_over: forces accelerate the new cloth as they did the old", "[run]") {
  const int old_level = GENERATE(0, 2);
  const int new_level = GENERATE(0, 1, 3);
  CAPTURE(old_level, new_level);
  const QuadMesh coarse = refined(old_level);
  const QuadMesh fine = refined(new_level);
  const ClothModel old_model = sheet_model(coarse, library_fabric("silk"));
  const ClothModel fresh_model = sheet_model(fine, library_fabric("leather"));
  const State old_state{coarse.rest_positions(), Positions::Zero(3, coarse.n_vertices())};
  const MovingSheet old{coarse, old_model, old_state};
  const State fresh_state = carried_state(old, fine);
  const MovingSheet fresh{fine, fresh_model, fresh_state};
  const Vec3 lift(1, 9.81, -2);
  const Positions forces = lift * old_model.masses.transpose();
  const Positions carried = carried_forces(forces, old, fresh);
  CHECK((carried - lift * fresh_model.masses.transpose()).cwiseAbs().maxCoeff() < 1e-14);
  CHECK(carried_forces({}, old, fresh).isZero(0));
}

TEST_CASE("carry_over: in the next 0.1 s nothing is 1.5 times as fast, but for what falls",
          "[run]") {
  struct Change {
    const char* scene;
    int n_steps;  // steps of 1/60 s before the change: the cloth is in real motion then
    int old_level;
    const char* old_fabric;
    int new_level;
    const char* new_fabric;
  };
  const auto change =
      GENERATE(values<Change>({{"swinging_sheet", 24, 1, "canvas", 2, "spandex"},
                               {"swinging_sheet", 24, 2, "spandex", 1, "canvas"},
                               {"swinging_sheet", 24, 0, "silk", 1, "coarse cotton (denim)"},
                               {"swinging_sheet", 24, 1, "chiffon", 1, "leather"},
                               {"swinging_sheet", 24, 1, "leather", 2, "chiffon"},
                               {"curtain", 60, 0, "fine cotton", 2, "fine cotton"},
                               {"curtain", 60, 2, "spandex", 1, "canvas"},
                               {"curtain", 60, 1, "coarse cotton (denim)", 1, "silk"},
                               {"tablecloth", 24, 1, "canvas", 2, "spandex"},
                               {"tablecloth", 24, 2, "wool", 1, "silk"},
                               {"tablecloth", 24, 0, "leather", 1, "chiffon"}}));
  const auto stepper =
      GENERATE(&steppers::kImplicitEuler, &steppers::kProjective, &steppers::kXpbd);
  CAPTURE(change.scene, change.old_level, change.old_fabric, change.new_level, change.new_fabric,
          stepper->name);
  Simulation old(moving_scene(change.scene, stepper, change.old_level, change.old_fabric));
  for (int s = 0; s < change.n_steps; ++s) old.step();
  Simulation changed(moving_scene(change.scene, stepper, change.new_level, change.new_fabric));
  changed.carry_over(old);
  // Cloth that would have sped up anyway may do so, and what is softer now may begin to fall.
  double before = largest_speed(old);
  double after = 0;
  for (int s = 0; s < 6; ++s) {
    old.step();
    changed.step();
    before = std::max(before, largest_speed(old));
    after = std::max(after, largest_speed(changed));
  }
  CHECK(after <= std::max(1.5 * before, before + 9.81 * 0.1));
}

TEST_CASE("carry_over: after the transition the cloth is its own to the bit", "[run]") {
  const auto stepper = GENERATE(&steppers::kImplicitEuler, &steppers::kProjective);
  Simulation old(moving_scene("tablecloth", stepper, 1, "silk"));
  for (int s = 0; s < 10; ++s) old.step();
  const Scene scene = moving_scene("tablecloth", stepper, 0, "leather");
  Simulation changed(scene);
  const ClothModel own = changed.model();
  const Collider& ball = own.contact->colliders().back();
  changed.carry_over(old);
  changed.step();
  CHECK(changed.model().springs[0].rest_length != own.springs[0].rest_length);
  CHECK(changed.model().contact->clearance(ball, VertexId(0)).at_a <
        own.contact->clearance(ball, VertexId(0)).at_a);
  while (changed.time() - old.time() < kTransitionTime + scene.method.step) changed.step();
  for (std::size_t s = 0; s < own.springs.size(); ++s)
    CHECK(changed.model().springs[s].rest_length == own.springs[s].rest_length);
  CHECK(changed.model().contact->clearance(ball, VertexId(0)).at_a ==
        own.contact->clearance(ball, VertexId(0)).at_a);
}

TEST_CASE("carry_over: the same cloth at rest on a ball goes on resting", "[run]") {
  const auto stepper = GENERATE(&steppers::kImplicitEuler, &steppers::kProjective);
  CAPTURE(stepper->name);
  const Scene scene = moving_scene("tablecloth", stepper, 0, "silk");
  Simulation old(scene);
  while (old.time() < 3) old.step();
  Simulation changed(scene);
  changed.carry_over(old);
  for (int s = 0; s < 6; ++s) {  // both still sway by some millimetres a second
    old.step();
    changed.step();
  }
  CHECK(largest_speed(changed) < 1.05 * largest_speed(old));
}

TEST_CASE("carry_over: drag keeps up with the weight through two changes", "[run]") {
  const auto at = [](const char* fabric) {
    return moving_scene("curtain", &steppers::kImplicitEuler, 0, fabric);
  };
  Simulation silk(at("silk"));
  for (int s = 0; s < 10; ++s) silk.step();
  Simulation canvas(at("canvas"));
  canvas.carry_over(silk);
  canvas.step();
  const double canvas_over_silk = canvas.model().masses.sum() / silk.model().masses.sum();
  CHECK(canvas.model().air->strength() == Approx(canvas_over_silk));
  Simulation leather(at("leather"));
  leather.carry_over(canvas);
  leather.step();
  CHECK(leather.model().air->strength() ==
        Approx(leather.model().masses.sum() / silk.model().masses.sum()));
}

TEST_CASE("carry_over: a reset on the way is the scene from its beginning, to the bit", "[run]") {
  Simulation old(moving_scene("tablecloth", &steppers::kImplicitEuler, 1, "silk"));
  for (int s = 0; s < 30; ++s) old.step();
  const Scene scene = moving_scene("tablecloth", &steppers::kImplicitEuler, 0, "leather");
  Simulation changed(scene);
  changed.carry_over(old);
  for (int s = 0; s < 10; ++s) changed.step();
  changed.reset();
  Simulation fresh(scene);
  for (int s = 0; s < 40; ++s) {
    changed.step();
    fresh.step();
  }
  CHECK(changed.time() == fresh.time());
  CHECK(changed.state().positions == fresh.state().positions);
  CHECK(changed.state().velocities == fresh.state().velocities);
}

TEST_CASE("carry_over: what a cloth is gauged by does not change with what it was before",
          "[run]") {
  Scene old = released_sheet_scene(3, "leather");
  Scene fresh = released_sheet_scene(3, "chiffon");
  fresh.level = 1;
  Simulation before(old);
  before.step();
  Simulation after(fresh);
  const std::vector<GaugeEdge> own = after.gauge();
  after.carry_over(before);
  after.step();
  const std::vector<GaugeEdge>& now = after.gauge();
  REQUIRE(now.size() == own.size());
  for (std::size_t i = 0; i < own.size(); ++i) {
    CHECK(now[i].a == own[i].a);
    CHECK(now[i].b == own[i].b);
    CHECK(now[i].rest_length == own[i].rest_length);
  }
}

}  // namespace pleat
