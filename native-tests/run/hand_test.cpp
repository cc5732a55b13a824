#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "core/dynamics/stepper_table.h"
#include "core/run/hand_reach.h"
#include "core/run/simulation.h"
#include "core/scene/cloth/particle_cloth.h"
#include "core/scene/format/scene_file.h"
#include "native-tests/support/assets.h"
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

// Cells three times as high as wide: a hand beside a vertex that hangs in the middle of a cell's
// side is wide enough for it, but not for its parents. Pulled away from it, only the thread
// between them holds the hand back at once.
TEST_CASE("hand: a thread to a vertex that hangs bounds it, as what hangs is not held", "[run]") {
  Scene scene = hanging_scene(everyday_methods()[1]);
  change_cloth<SheetCloth>(scene, [](SheetCloth& sheet) {
    sheet.shape.width = 0.12;
    sheet.shape.height = 0.36;
  });
  scene.plan = patchy_plan(*base_quads(scene));
  Simulation simulation(scene);
  const Positions& rest = simulation.rest_positions();
  const HangingVertex hanging = simulation.model().hanging.back();
  const auto from_it = [&](VertexId v) { return Vec3(rest.col(v) - rest.col(hanging.vertex)); };
  VertexId beside;
  for (const GaugeEdge& edge : simulation.gauge())
    for (const auto& [near, far] : {std::pair(edge.a, edge.b), std::pair(edge.b, edge.a)})
      if (near == hanging.vertex && far != hanging.parents[0] && far != hanging.parents[1])
        beside = far;
  REQUIRE(beside.valid());
  const double radius = kHandRadius * scene.cloth->rest_diagonal();
  const double length = from_it(beside).norm();
  REQUIRE(length < radius);
  REQUIRE(from_it(hanging.parents[0]).norm() > radius);
  simulation.grab(beside);
  const Vec3 begin = simulation.state().positions.col(beside);
  simulation.move_grab(begin + from_it(beside) / 2);
  REQUIRE(simulation.step().ok());
  const double moved = (simulation.state().positions.col(beside) - begin).norm();
  CHECK(moved == Approx(kHandStretch * length).epsilon(1e-6));
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

// The hand is wide enough for vertices that no pin holds on the finer mesh.
TEST_CASE("hand: at a pin it holds nothing, and asks nothing of the cloth", "[run]") {
  Scene scene = hanging_scene(everyday_methods()[1]);
  scene.level = GENERATE(0, 2);
  CAPTURE(scene.level);
  Simulation simulation(scene);
  const std::size_t n_pins = simulation.model().pins.size();
  simulation.grab(VertexId(2));
  simulation.move_grab(simulation.state().positions.col(2) + Vec3(0, -0.5, 1));
  CHECK(simulation.is_grabbed());
  CHECK(simulation.model().pins.size() == n_pins);
  CHECK(simulation.asked_stretch() == 0);
  simulation.grab(kLowerCorner);
  CHECK(simulation.model().pins.size() > n_pins);
  CHECK(simulation.asked_stretch() > 0.9);
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

// Fine cotton of half a metre on its upper edge, pulled at a lower corner from twice as far as it
// reaches. Twice the bound leaves room for soft methods, and for threads that a corner gathers.
TEST_CASE("hand: it gives way where the cloth is taut", "[run]") {
  for (const MethodOptions& method : everyday_methods()) {
    CAPTURE(method.stepper->name);
    Simulation simulation(hanging_scene(method));
    simulation.grab(kLowerCorner);
    CHECK(simulation.asked_stretch() == Approx(1).epsilon(0.01));
    const Vec3 begin = simulation.state().positions.col(kLowerCorner.value);
    double most = 0;
    for (int s = 1; s <= 120; ++s) {
      simulation.move_grab(begin + std::min(s / 60.0, 1.0) * Vec3(0.5, -2, 0.5));
      REQUIRE(simulation.step().ok());
      most = std::max(most, stretch(simulation.gauge(), simulation.state().positions).largest);
    }
    CHECK(simulation.asked_stretch() > 2);
    CHECK(most < 2 * kHandStretch);
    const Vec3 end = simulation.state().positions.col(kLowerCorner.value);
    CHECK((end - begin).norm() < 1);
  }
}

// One pin at one side of the waist, and a hand at the other.
TEST_CASE("hand: the way to a pin of a garment is round its body", "[run]") {
  const auto beside = [](const std::string& name) {
    return repository_file("assets/scenes/garments/" + name);
  };
  Scene scene = read_scene(beside("skirt_walk.json"), fabric_library(), beside);
  scene.start.reset();
  scene.level = 0;
  const std::vector<VertexId> waist = scene.cloth->base_part("waist");
  const std::size_t half = waist.size() / 2;
  scene.pins = {PinRule{std::vector<VertexId>{waist[0]}, {}}};
  Simulation simulation(scene);
  const Positions& rest = simulation.rest_positions();
  const auto distance = [&](std::size_t a, std::size_t b) {
    return (rest.col(waist[a]) - rest.col(waist[b])).norm();
  };
  double way = 0;
  for (std::size_t k = 0; k < half; ++k) way += distance(k, k + 1);
  REQUIRE(distance(0, half) < 0.8 * way);
  simulation.grab(waist[half]);
  CHECK(simulation.asked_stretch() == Approx(distance(0, half) / way).epsilon(1e-3));
}

// One vertex at the origin, held; another one beside it.
struct HeldPair {
  State state{Positions::Zero(3, 2), Positions::Zero(3, 2)};
  Vec3 move(HandReach& reach, const Vec3& target, double h = 1) const {
    return reach.move(state, VertexId(0), target, 0, h);
  }
};

TEST_CASE("hand_reach: a hand is no faster than an arm", "[run]") {
  HandReach free({}, {}, {}, {}, 0);
  const HeldPair pair;
  CHECK((pair.move(free, {0, 3, 4}, 0.1) - kHandSpeed * 0.1 * Vec3(0, 0.6, 0.8)).norm() < 1e-12);
  CHECK(pair.move(free, {0, 0.1, 0}, 0.1) == Vec3(0, 0.1, 0));
}

// The place of that vertex between two pins 1 m apart, with ways of 0.7 m, when a hand has wanted
// it at a target for some steps.
Vec3 end_between_pins(const Vec3& target, double radius = 0, double stretch = 0) {
  const std::vector<Pin> pins = {{VertexId(0), {0, 0, 0}, {}}, {VertexId(1), {1, 0, 0}, {}}};
  HeldPair pair;
  pair.state.positions.col(0) = Vec3(0.5, 0, 0);
  HandReach reach(Eigen::Vector2d(0.7, 0.7), pins, {}, {{0.5, 0, 0}, 0, radius}, stretch);
  for (int step = 0; step < 10; ++step) pair.state.positions.col(0) += pair.move(reach, target);
  return pair.state.positions.col(0);
}

TEST_CASE("hand_reach: it ends where ways to pins are taut, next to its target", "[run]") {
  const double height = std::sqrt(0.7 * 0.7 - 0.25);
  for (const Vec3& target : {Vec3(0.5, 3, 0), Vec3(0.4, 3, 0), Vec3(0.2, 1.5, 0)})
    CHECK((end_between_pins(target) - Vec3(0.5, height, 0)).norm() < 1e-3);
  CHECK((end_between_pins({0.7, -2, 0}) - Vec3(0.5, -height, 0)).norm() < 1e-3);
  const Vec3 aside(0.9, 0.3, 2);  // one pin holds it back, the other way stays slack
  CHECK((end_between_pins({0.9, 0.1, 0}) - 0.7 * Vec3(0.9, 0.1, 0).normalized()).norm() < 1e-3);
  const double depth = std::sqrt(0.7 * 0.7 - 0.25);
  const Vec3 on_both(0.5, depth * 0.3 / std::hypot(0.3, 2.0), depth * 2 / std::hypot(0.3, 2.0));
  CHECK((end_between_pins(aside) - on_both).norm() < 1e-3);
  CHECK((end_between_pins({0.5, 0.1, 0}) - Vec3(0.5, 0.1, 0)).norm() < 1e-12);
}

TEST_CASE("hand_reach: its pull lengthens what is beyond its radius", "[run]") {
  CHECK(end_between_pins({5, 0, 0}).x() == Approx(0.7).margin(1e-3));
  CHECK(end_between_pins({5, 0, 0}, 0.1, 0.05).x() == Approx(0.7 + 0.05 * 0.6).margin(1e-3));
  const std::vector<Pin> pins = {{VertexId(0), {0, 0, 0}, {}}, {VertexId(1), {1, 0, 0}, {}}};
  const HandReach reach(Eigen::Vector2d(0.7, 0.7), pins, {}, {}, 0);
  CHECK(reach.asked({0.5, 3, 0}, 0) == Approx(std::sqrt(9.25) / 0.7));
}

// Soft methods leave ways and threads longer than a hand would draw them.
TEST_CASE("hand_reach: a hand that does not move draws nothing in", "[run]") {
  HeldPair pair;
  pair.state.positions.col(1) = Vec3(0.3, 0, 0);
  const std::vector<Pin> pins = {{VertexId(1), {0, 0.5, 0}, {}}};
  HandReach reach(Eigen::Vector2d(0, 0.4), pins, {{VertexId(0), VertexId(1), 0.3}}, {}, 0);
  CHECK(pair.move(reach, {0, 0, 0}).norm() < 1e-15);
}

TEST_CASE("hand_reach: no thread beside the hand is stretched beyond a tenth", "[run]") {
  HandReach reach({}, {}, {{VertexId(0), VertexId(1), 0.22}}, {}, 0);
  HeldPair pair;
  pair.state.positions.col(1) = Vec3(0.2, 0, 0);
  CHECK((pair.move(reach, {-1, 0, 0}) - Vec3(-0.02, 0, 0)).norm() < 1e-12);
  pair.state.velocities.col(1) = Vec3(-0.1, 0, 0);
  CHECK((pair.move(reach, {-1, 0, 0}) - Vec3(-0.12, 0, 0)).norm() < 1e-12);
  pair.state.velocities.col(1) = Vec3(0.5, 0, 0);
  CHECK(pair.move(reach, {0, 0, 0}).isZero(1e-12));
}

TEST_CASE("hand_reach: ways along edges are the shortest", "[run]") {
  // A square with one diagonal, and an edge apart.
  const std::vector<GaugeEdge> edges = {{VertexId(2), VertexId(3), 1},
                                        {VertexId(1), VertexId(2), 1},
                                        {VertexId(0), VertexId(1), 1},
                                        {VertexId(0), VertexId(3), 3},
                                        {VertexId(4), VertexId(5), 1}};
  const Eigen::VectorXd ways = ways_along(edges, VertexId(0), 6);
  CHECK(ways.head(4) == Eigen::Vector4d(0, 1, 2, 3));
  CHECK(std::isinf(ways[4]));
}

}  // namespace pleat
