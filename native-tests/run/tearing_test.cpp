#include "core/scene/tearing.h"

#include <catch2/catch.hpp>
#include <utility>

#include "core/base/check.h"
#include "core/dynamics/stepper_table.h"
#include "core/mesh/cut_faces.h"
#include "core/mesh/mesh_fault.h"
#include "core/run/run_ledger.h"
#include "core/run/run_watch.h"
#include "core/run/sampled_run.h"
#include "core/run/simulation.h"
#include "core/scene/cloth/mesh_cloth.h"
#include "native-tests/support/models.h"
#include "native-tests/support/topology.h"

namespace pleat {
namespace {

constexpr double kLimit = 0.2;  // breaking elongation

std::shared_ptr<const Tearing> tearing(double breaking_elongation) {
  auto result = std::make_shared<Tearing>();
  result->breaking_elongation = breaking_elongation;
  return result;
}

PinRule pulled(const char* part, const Vec3& offset) {
  return {part, {Motion::Kind::move, offset, 0, 1, 0}};
}

/// A sheet that hangs from its upper edge, one of whose corners is pulled away.
Scene pulled_scene(const MethodOptions& method) {
  Scene scene = released_sheet_scene(6, "fine cotton");
  scene.cloth = SheetCloth(SheetShape{1, 1, 6, 6});
  scene.pins.push_back(pulled("lower_left", {-0.6, -0.6, 0.3}));
  scene.method = method;
  scene.model.tearing = tearing(kLimit);
  return scene;
}

/// Scene of a triangle mesh held by a membrane.
Scene pulled_mesh_scene(const MethodOptions& method) {
  Scene scene = pulled_scene(method);
  MeshCloth mesh;
  mesh.mesh = triangulated_sheet(Triangulation::crossed, 6, 6, 1.0 / 6);
  const Positions& x = mesh.mesh.rest_positions;
  VertexGroup held{"held", {}};
  for (int v = 0; v < mesh.mesh.n_vertices(); ++v)
    if (x(0, v) == 0) held.vertices.emplace_back(v);
  Eigen::Index farthest = 0;
  x.row(0).maxCoeff(&farthest);
  mesh.groups = {held, {"corner", {VertexId(farthest)}}};
  scene.cloth = std::move(mesh);
  scene.pins = {{"held", {}}, pulled("corner", {1.6, 0.6, 0.6})};
  scene.model.elasticity = Elasticity::membrane;
  scene.model.bending = BendingModel::fitted;
  return scene;
}

double largest_strain(const Simulation& simulation) {
  return stretch(simulation.gauge(), simulation.state().positions).largest;
}

void step(Simulation& simulation) {
  const SolveReport report = simulation.step();
  CAPTURE(report.message);
  REQUIRE_FALSE(report.ends_run());
}

std::size_t n_splits(const Simulation& simulation) { return simulation.tear_origins().size(); }

/// Vertex of the whole cloth that each one comes from.
std::vector<VertexId> roots(const Simulation& simulation) {
  std::vector<VertexId> roots;
  roots.reserve(static_cast<std::size_t>(simulation.model().n_vertices()));
  const int n_whole = simulation.model().n_vertices() - static_cast<int>(n_splits(simulation));
  for (int v = 0; v < n_whole; ++v) roots.emplace_back(v);
  for (const VertexId origin : simulation.tear_origins()) roots.push_back(roots[origin]);
  return roots;
}

MethodOptions usual_method() { return steppers::kImplicitEuler.usual_method(); }

}  // namespace

TEST_CASE("tearing: a strip that is pulled apart is two pieces, each with half of its mass",
          "[run]") {
  Scene scene;
  scene.cloth = SheetCloth(SheetShape{0.2, 0.1, 2, 1});
  scene.fabric = library_fabric("fine cotton");
  scene.gravity.setZero();
  scene.pins = {{"left_edge", {}}, pulled("right_edge", {0.1, 0, 0})};
  scene.model.tearing = tearing(kLimit);
  Simulation simulation(scene);
  const double mass = simulation.model().masses.sum();
  double strain_before = 0;
  while (n_splits(simulation) == 0 && simulation.n_steps() < 60) {
    strain_before = largest_strain(simulation);
    CHECK(simulation.topology() == 0);
    step(simulation);
    REQUIRE((n_splits(simulation) > 0) == (strain_before > kLimit));
  }
  // Both ends of the cut: inside of the strip there is one edge.
  REQUIRE(n_splits(simulation) == 2);
  CHECK(simulation.topology() == 1);
  const Topology pieces = topology(simulation.triangles(), 8);
  CHECK(pieces.is_manifold);
  CHECK(pieces.n_components == 2);
  CHECK(pieces.euler == 2);
  CHECK(simulation.model().masses.sum() == Approx(mass).epsilon(1e-12));
  CHECK(simulation.model().masses.isConstant(mass / 8, 1e-12));
  for (int s = 0; s < 60; ++s) step(simulation);
  CHECK(n_splits(simulation) == 2);
  CHECK(largest_strain(simulation) < 0.01);
}

TEST_CASE("tearing: with every stepper torn cloth stays sound and keeps its mass and its pins",
          "[run][long]") {
  std::vector<Scene> scenes;
  for (const MethodOptions& method : everyday_methods()) scenes.push_back(pulled_scene(method));
  for (const MethodOptions& method : accurate_methods(1.0 / 120)) {
    scenes.push_back(pulled_scene(method));
    scenes.push_back(pulled_mesh_scene(method));
  }
  scenes.push_back(pulled_mesh_scene(usual_method()));
  for (const Scene& scene : scenes) {
    CAPTURE(scene.method.stepper->name, scene.cloth->key());
    Simulation simulation(scene);
    const Eigen::VectorXd masses = simulation.model().masses;
    const auto pins = simulation.model().pins;
    std::size_t n_before = 0;
    for (int s = 0; s < 60; ++s) {
      step(simulation);
      REQUIRE(simulation.state().positions.allFinite());
      if (std::exchange(n_before, n_splits(simulation)) == n_splits(simulation)) continue;
      REQUIRE(topology(simulation.triangles(), simulation.model().n_vertices()).is_manifold);
      REQUIRE_FALSE(mesh_fault(simulation.rest_positions(), simulation.triangles(), 0));
    }
    REQUIRE(n_splits(simulation) > 0);
    // As a vertex and those that it split into go on with one velocity, this keeps momentum too.
    Eigen::VectorXd shared = Eigen::VectorXd::Zero(masses.size());
    const std::vector<VertexId> root = roots(simulation);
    for (std::size_t v = 0; v < root.size(); ++v)
      shared[root[v]] += simulation.model().masses[static_cast<Eigen::Index>(v)];
    CHECK((shared - masses).cwiseAbs().maxCoeff() < 1e-12 * masses.maxCoeff());
    REQUIRE(simulation.model().pins.size() == pins.size());
    for (std::size_t p = 0; p < pins.size(); ++p) {
      CHECK(simulation.model().pins[p].vertex == pins[p].vertex);
      for (const VertexId origin : simulation.tear_origins()) CHECK(origin != pins[p].vertex);
    }
  }
}

TEST_CASE("tearing: what splits goes on with the velocity and from the place that it had",
          "[run]") {
  const Vec3 velocity(0.3, -0.2, 0.5);
  Scene scene = pulled_scene(usual_method());
  scene.cloth = SheetCloth(SheetShape{1, 1, 6, 6}, velocity);
  scene.pins.clear();
  scene.method.step = 1e-10;  // too short for any force to matter
  Simulation simulation(scene);
  const Positions stretched = 1.5 * simulation.state().positions;
  simulation.start_from(stretched);
  for (int s = 0; s < 5; ++s) step(simulation);
  REQUIRE(n_splits(simulation) > 3);
  const std::vector<VertexId> root = roots(simulation);
  for (std::size_t v = 0; v < root.size(); ++v) {
    const auto column = static_cast<Eigen::Index>(v);
    CHECK((simulation.state().velocities.col(column) - velocity).norm() < 1e-3);
    CHECK((simulation.state().positions.col(column) - stretched.col(root[v])).norm() < 1e-8);
  }
}

TEST_CASE("tearing: cloth that can tear moves to the bit like any other until it does", "[run]") {
  for (const MethodOptions& method : everyday_methods()) {
    CAPTURE(method.stepper->name);
    Scene scene = pulled_scene(method);
    Simulation tears(scene);
    scene.model.tearing = nullptr;
    Simulation holds(scene);
    step(tears);
    for (; n_splits(tears) == 0; step(tears)) {
      step(holds);
      REQUIRE(tears.state().positions == holds.state().positions);
      REQUIRE(tears.state().velocities == holds.state().velocities);
    }
    CHECK(holds.n_steps() > 5);
  }
}

TEST_CASE("tearing: the same scene tears to the same bits, and so it does after a reset", "[run]") {
  Simulation first(pulled_scene(usual_method()));
  Simulation second(pulled_scene(usual_method()));
  const auto run = [](Simulation& simulation) {
    for (int s = 0; s < 40; ++s) step(simulation);
    return simulation.state();
  };
  const State torn = run(first);
  REQUIRE(n_splits(first) > 0);
  CHECK(run(second).positions == torn.positions);
  const std::int64_t topology = first.topology();
  first.reset();
  CHECK(first.topology() == topology + 1);
  CHECK(n_splits(first) == 0);
  CHECK(first.model().n_vertices() == 49);
  CHECK(first.state().positions == Simulation(pulled_scene(usual_method())).state().positions);
  CHECK(run(first).positions == torn.positions);
  CHECK(first.state().velocities == torn.velocities);
}

TEST_CASE("tearing: torn cloth can start from other places, whole", "[run]") {
  Simulation simulation(pulled_scene(usual_method()));
  const Positions places = 1.01 * simulation.state().positions;
  while (n_splits(simulation) == 0) step(simulation);
  CHECK_THROWS_AS(simulation.start_from(simulation.state().positions), InputError);
  simulation.start_from(places);
  CHECK(n_splits(simulation) == 0);
  CHECK(simulation.state().positions == places);
}

TEST_CASE("tearing: a hand keeps what it holds while the cloth tears", "[run]") {
  Scene scene = pulled_scene(usual_method());
  scene.pins.pop_back();
  Simulation simulation(scene);
  const VertexId corner(48);
  simulation.grab(corner);
  const Vec3 begin = simulation.state().positions.col(corner);
  Vec3 target = begin;
  for (int s = 1; s <= 60; ++s) {
    target = begin + s / 60.0 * Vec3(0.6, -0.6, 0.3);
    simulation.move_grab(target);
    step(simulation);
    REQUIRE((simulation.state().positions.col(corner) - target).norm() < 1e-12);
  }
  REQUIRE(n_splits(simulation) > 0);
  simulation.release_grab();
  CHECK(simulation.model().pins.size() == 7);
  step(simulation);
  CHECK((simulation.state().positions.col(corner) - target).norm() > 1e-6);
}

TEST_CASE("tearing: what a solid holds goes on being held", "[run]") {
  // At rest over a ball, until a hand slowly tears one corner off. Were the ball's support
  // forgotten, what hangs would fall freely for a substep and then jerk at what lies, to 3 % of
  // strain; the tear itself leaves more load to the threads beside it, but not twice as much.
  Scene scene = pulled_scene(usual_method());
  scene.cloth = SheetCloth(SheetShape{1, 1, 6, 6, {-0.5, 0.32, -0.5}, {0, 0, 1}, {1, 0, 0}});
  scene.colliders = {{Sphere{{0, 0, 0}, 0.3}, {}, 1}};
  scene.pins.clear();
  scene.model.tearing = tearing(0.005);
  Simulation simulation(scene);
  for (int s = 0; s < 300; ++s) step(simulation);
  REQUIRE(n_splits(simulation) == 0);
  simulation.grab(VertexId(48));
  Vec3 target = simulation.state().positions.col(48);
  while (n_splits(simulation) == 0 && simulation.n_steps() < 400) {
    target += Vec3(0.0005, 0, 0.0005);
    simulation.move_grab(target);
    step(simulation);
  }
  REQUIRE(n_splits(simulation) > 0);
  CHECK(largest_strain(simulation) < 2 * scene.model.tearing->breaking_elongation);
}

TEST_CASE("tearing: the account of energy goes on, with what tears took", "[run]") {
  Simulation simulation(pulled_scene(usual_method()));
  RunLedger ledger(simulation);
  RunWatch watch(simulation);
  const double before = total_energy(simulation.model(), simulation.state());
  for (int s = 0; s < 40; ++s) {
    const SolveReport report = simulation.step();
    ledger.record_step();
    watch.check(simulation, report);
  }
  REQUIRE(n_splits(simulation) > 0);
  const EnergyLedger& account = ledger.account();
  const double after = total_energy(simulation.model(), simulation.state());
  CHECK(account.parts().sum() == after);
  CHECK(account.works().tears < 0);
  CHECK(account.works().sum() + account.drift() == Approx(after - before));
  CHECK(watch.warnings().empty());
}

TEST_CASE("tearing: cloth whose motion is taken over does not tear while it becomes its own",
          "[run]") {
  Scene scene = pulled_scene(usual_method());
  scene.model.tearing = nullptr;
  Simulation holds(scene);
  while (largest_strain(holds) < 1.1 * kLimit) step(holds);
  scene.model.tearing = tearing(kLimit);
  Simulation tears(scene);
  tears.carry_over(holds);
  const double begin = tears.time();
  while (tears.time() < begin + kTransitionTime) {
    step(tears);
    REQUIRE(n_splits(tears) == 0);
  }
  REQUIRE(largest_strain(tears) > kLimit);
  step(tears);
  CHECK(n_splits(tears) > 0);
}

TEST_CASE("tearing: a run whose vertices have to stay refuses it", "[run]") {
  CHECK_THROWS_WITH(SampledRun(pulled_scene(usual_method()), {1}, SampledRun::Parts::untimed),
                    Catch::Contains("keep its vertices"));
  const Scene scene = pulled_scene(usual_method());
  Simulation torn(scene);
  while (n_splits(torn) == 0) step(torn);
  Simulation fresh(scene);
  CHECK_THROWS_AS(fresh.carry_over(torn), ContractError);
}

}  // namespace pleat
