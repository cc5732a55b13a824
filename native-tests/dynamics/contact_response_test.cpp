#include <catch2/catch.hpp>
#include <cmath>

#include "core/dynamics/stepper_table.h"
#include "native-tests/support/models.h"
#include "native-tests/support/particle.h"

namespace pleat {
namespace {

/// Every stepper with substeps of 1/1000 s or less.
std::vector<MethodOptions> fine_methods() {
  std::vector<MethodOptions> methods = everyday_methods();
  for (MethodOptions& options : methods) {
    options.step = 0.01;
    options.substeps = 20;
  }
  return methods;
}

ClothModel particle_on(const Collider& collider) {
  ClothModel model;
  model.masses = Eigen::VectorXd::Constant(1, 0.3);
  model.contact.emplace(std::vector<Collider>{collider}, ContactOptions{});
  return model;
}

State state_at(const Vec3& position) { return {position, Positions::Zero(3, 1)}; }

void advance(Stepper& stepper, State& state, int from, int to) {
  for (int s = from; s < to; ++s) REQUIRE(stepper.advance(state, s * stepper.options().step).ok());
}

}  // namespace

TEST_CASE("contact: a particle leaves a smooth ball where cos = 2/3, with every stepper",
          "[contact]") {
  for (const MethodOptions& options : fine_methods()) {
    CAPTURE(options.stepper->name);
    ClothModel model = particle_on(ball_collider(Vec3::Zero(), 1, 0));
    const auto stepper = make_stepper(model, options);
    State state = state_at({std::sin(0.1), std::cos(0.1), 0});
    double left_at = 0;
    for (int s = 0; left_at == 0 && s < 300; ++s) {
      advance(*stepper, state, s, s + 1);
      if (state.positions.norm() > 1 + 1e-5) left_at = state.positions.col(0).normalized().y();
    }
    // It starts at rest at cos 0.1, hops by 1e-6 m per substep, and is a little lower when clear.
    CHECK(left_at == Approx(2.0 / 3 * std::cos(0.1)).margin(0.05));
  }
}

TEST_CASE("contact: a particle that has rested for long is lifted at once", "[contact]") {
  for (const MethodOptions& options : fine_methods()) {
    CAPTURE(options.stepper->name);
    ClothModel model = particle_on(floor_collider(0.5));
    const auto stepper = make_stepper(model, options);
    State state = state_at({0, 0, 0});
    advance(*stepper, state, 0, 200);
    CHECK(state.positions.col(0).norm() < 1e-12);
    state.velocities.col(0) = Vec3(0, 2, 0);
    advance(*stepper, state, 200, 210);
    CHECK(state.positions(1, 0) == Approx(2 * 0.1 - 9.81 * 0.01 / 2).epsilon(0.01));
  }
}

TEST_CASE("contact: friction stops a sliding particle after v^2 / (2 mu g)", "[contact]") {
  for (const MethodOptions& options : fine_methods()) {
    CAPTURE(options.stepper->name);
    ClothModel model = particle_on(floor_collider(0.4));
    const auto stepper = make_stepper(model, options);
    State state = state_at({0, 0, 0});
    state.velocities.col(0) = Vec3(1, 0, 0);
    advance(*stepper, state, 0, 100);
    CHECK(state.velocities.norm() < 1e-9);
    CHECK(state.positions(0, 0) == Approx(1 / (2 * 0.4 * 9.81)).epsilon(0.01));
  }
}

TEST_CASE(
    "contact: implicit finds in a few substeps with what force a floor holds a stiff string up",
    "[contact]") {
  // Two springs from pins at (-+1, -0.1, 0) below the floor to a particle that it holds up.
  const double stiffness = 1e5;  // [N/m]: h^2 k is 1000 times the mass
  ClothModel model = particle_on(floor_collider(0.5));
  model.masses = Eigen::VectorXd::Constant(3, 0.01);
  model.gravity = Vec3::Zero();
  model.springs = {{VertexId(0), VertexId(1), stiffness, 1},
                   {VertexId(1), VertexId(2), stiffness, 1}};
  model.pins = {Pin{VertexId(0), Vec3(-1, -0.1, 0), {}}, Pin{VertexId(2), Vec3(1, -0.1, 0), {}}};
  State state;
  state.positions.resize(3, 3);
  state.positions << -1, 0, 1, -0.1, 0, -0.1, 0, 0, 0;
  state.velocities = Positions::Zero(3, 3);
  MethodOptions options;
  options.step = 0.01;
  const auto stepper = make_stepper(model, options);
  advance(*stepper, state, 0, 40);
  const double length = std::hypot(1, 0.1);
  CHECK(std::abs(state.positions(1, 1)) < 1e-12);
  CHECK(stepper->contact_forces()(1, 1) ==
        Approx(2 * stiffness * (length - 1) * 0.1 / length).epsilon(1e-6));
}

}  // namespace pleat
