#include "core/run/equilibrium_check.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/dynamics/stepper_table.h"
#include "native-tests/support/models.h"
#include "native-tests/support/particle.h"

namespace pleat {
namespace {

constexpr double kSecond = 1;  // some time [s]

double share_of(const ClothModel& model, const State& state) {
  EquilibriumCheck check(model);
  const auto share = check.unbalanced_share(state, kSecond);
  REQUIRE(share);
  return *share;
}

/// A flat sheet of 1 m in the plane y = 0, and at rest there.
struct FlatSheet {
  ClothModel model;
  State state;

  explicit FlatSheet(const std::string& fabric = "linen", int cells = 6) {
    const QuadMesh mesh = lying_sheet(cells);
    model = sheet_model(mesh, library_fabric(fabric));
    model.gravity = {0, -kGravity, 0};
    state = rest_state(mesh);
    state.positions.row(1).swap(state.positions.row(2));
  }

  void put_on(Collider solid) {
    model.contact.emplace(std::vector<Collider>{std::move(solid)}, ContactOptions{});
  }
  void move(const Vec3& velocity) { state.velocities.colwise() = velocity; }
  /// Turns gravity from the floor's normal.
  void tilt(double angle) { model.gravity = kGravity * Vec3(std::sin(angle), -std::cos(angle), 0); }
};

/// A spring that hangs from a pin at the origin.
ClothModel hung_particle(double stiffness, double mass) {
  ClothModel model;
  model.masses = Eigen::VectorXd::Constant(2, mass);
  model.springs = {{VertexId(0), VertexId(1), stiffness, 1}};
  model.pins = {Pin{VertexId(0), Vec3(0, 0, 0), {}}};
  return model;
}

}  // namespace

TEST_CASE("equilibrium_check: of cloth that nothing holds all of the weight is unbalanced",
          "[run]") {
  const FlatSheet sheet;
  CHECK(share_of(sheet.model, sheet.state) == Approx(1).epsilon(1e-6));
}

TEST_CASE("equilibrium_check: without weight there is no share of it", "[run]") {
  FlatSheet sheet;
  sheet.model.gravity.setZero();
  EquilibriumCheck check(sheet.model);
  CHECK_FALSE(check.unbalanced_share(sheet.state, 0));
}

// A spring that bears the share 1 - s of its load m g leaves s, of which a step of h moves it by
// h^2 s g/(1 + h^2 k/m).
TEST_CASE("equilibrium_check: a spring that bears part of its load leaves the other", "[run]") {
  const double stiffness = GENERATE(0.5, 20.0, 1e6);
  const double left = GENERATE(0.0, 0.25, 1.0);
  CAPTURE(stiffness, left);
  constexpr double kMass = 0.01;
  const ClothModel model = hung_particle(stiffness, kMass);
  State state{Positions::Zero(3, 2), Positions::Zero(3, 2)};
  state.positions(1, 1) = -1 - (1 - left) * kMass * kGravity / stiffness;
  const double h = kEquilibriumStep;
  const double share = left / (1 + h * h * stiffness / kMass);
  CHECK(share_of(model, state) == Approx(share).epsilon(1e-5).margin(1e-6));
}

TEST_CASE("equilibrium_check: a damper bears what the spring of creeping cloth does not", "[run]") {
  constexpr double kMass = 0.01;
  constexpr double kLeft = 0.25;
  constexpr double kDamping = 2;  // [N s/m]
  ClothModel model = hung_particle(20, kMass);
  model.springs[0].damping = kDamping;
  State state{Positions::Zero(3, 2), Positions::Zero(3, 2)};
  state.positions(1, 1) = -1 - (1 - kLeft) * kMass * kGravity / 20;
  state.velocities(1, 1) = -kLeft * kMass * kGravity / kDamping;
  CHECK(share_of(model, state) < 1e-6);
}

TEST_CASE("equilibrium_check: a chain in its closed form of equilibrium is balanced", "[run]") {
  const Chain chain;
  const ClothModel model = chain_model(chain);
  State state = hanging_state(chain);
  CHECK(share_of(model, state) < 1e-6);
  state.positions.row(1) *= 0.99;
  CHECK(share_of(model, state) > 0.05);
}

// Friction up to mu holds cloth on a slope up to the angle atan(mu); beyond, sin(a) - mu cos(a) of
// the weight is left.
TEST_CASE("equilibrium_check: a slope holds cloth by as much as its friction", "[run]") {
  const double friction = GENERATE(0.0, 0.2, 0.5, 1.0);
  const double angle = GENERATE(0.0, 0.1, 0.3, 0.7);
  CAPTURE(friction, angle);
  FlatSheet sheet;
  sheet.put_on(floor_collider(friction));
  sheet.tilt(angle);
  const double share = std::max(0.0, std::sin(angle) - friction * std::cos(angle));
  CHECK(share_of(sheet.model, sheet.state) == Approx(share).epsilon(0.02).margin(2e-3));
}

TEST_CASE("equilibrium_check: cloth at rest on a belt is balanced, under which it slides it is not",
          "[run]") {
  constexpr double kFriction = 0.3;
  const Vec3 speed(1, 0, 0);
  FlatSheet sheet;
  Collider belt = floor_collider(kFriction);
  belt.motion = steady_motion(speed);
  sheet.put_on(belt);
  CHECK(share_of(sheet.model, sheet.state) == Approx(kFriction).epsilon(0.01));
  sheet.move(speed);
  CHECK(share_of(sheet.model, sheet.state) < 1e-3);
}

TEST_CASE("equilibrium_check: what rides a belt is balanced at the moment that the belt stops",
          "[run]") {
  const Vec3 speed(1, 0, 0);
  FlatSheet sheet;
  Collider belt = floor_collider(0.3);
  belt.motion.kind = Motion::Kind::move;
  belt.motion.offset = kSecond * speed;
  belt.motion.time_end = kSecond;
  sheet.put_on(belt);
  sheet.move(speed);
  CHECK(share_of(sheet.model, sheet.state) < 1e-3);
}

// Walls that leave cloth half of its thickness press on it from both sides: rough ones hold it.
TEST_CASE("equilibrium_check: jaws hold what they close on, smooth ones do not", "[run]") {
  constexpr double kHalfThickness = 5e-4;
  const double friction = GENERATE(0.0, 1.0);
  CAPTURE(friction);
  FlatSheet sheet;
  std::vector<Collider> jaws;
  for (const double side : {-1.0, 1.0}) {
    Collider jaw = floor_collider(friction);
    jaw.shape = Plane{{0, side * kHalfThickness / 2, 0}, {0, -side, 0}};
    jaws.push_back(jaw);
  }
  sheet.model.gravity = Vec3(kGravity, 0, 0);
  sheet.model.contact.emplace(jaws, ContactOptions{kHalfThickness, {}});
  CHECK(share_of(sheet.model, sheet.state) == Approx(friction > 0 ? 0 : 1).margin(0.01));
}

TEST_CASE("equilibrium_check: a vertex just above the floor falls no further than onto it",
          "[run]") {
  FlatSheet sheet;
  sheet.put_on(floor_collider(0.3));
  constexpr double kHeight = 1e-4;
  sheet.state.positions.row(1).array() += kHeight;
  const double fall = kEquilibriumStep * kEquilibriumStep * kGravity;
  CHECK(share_of(sheet.model, sheet.state) == Approx(kHeight / fall).epsilon(0.05));
}

// Flat cloth falls at the speed v where drag rho C v^2/2 is its weight per area; at 1/sqrt(2) of
// it, that of cloth in twice the drag, half of the weight is left.
TEST_CASE("equilibrium_check: steady fall is balanced at the model's own speed alone", "[run]") {
  FlatSheet sheet;
  const AirOptions air;
  sheet.model.air.emplace(lying_sheet(6).crossed_triangles(), air, sheet.model.n_vertices(), 0.5);
  const double weight = sheet.model.masses.sum() * kGravity;  // [N], on 1 m^2
  const double speed = std::sqrt(2 * weight / (air.density * air.normal_coefficient));
  sheet.move({0, -speed, 0});
  CHECK(share_of(sheet.model, sheet.state) < 0.01);
  sheet.move({0, -speed / std::sqrt(2.0), 0});
  CHECK(share_of(sheet.model, sheet.state) == Approx(0.5).epsilon(0.02));
}

TEST_CASE("equilibrium_check: cloth that a strain limit holds has no known share", "[run]") {
  FlatSheet sheet;
  sheet.model.strain_limit.emplace();
  for (const Spring& spring : sheet.model.springs)
    sheet.model.strain_limit->edges.push_back({spring.a, spring.b, spring.rest_length});
  EquilibriumCheck check(sheet.model);
  CHECK(check.unbalanced_share(sheet.state, 0));
  sheet.state.positions *= 1 + sheet.model.strain_limit->options.stretch;
  CHECK_FALSE(check.unbalanced_share(sheet.state, 0));
}

}  // namespace pleat
