#include <algorithm>
#include <array>
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

constexpr double kStringStiffness = 1e5;  // [N/m]: h^2 k is 1000 times the mass below

/// Two springs from pins at (-+1, -0.1, 0) to a particle that the floor holds up.
ClothModel string_over_floor() {
  ClothModel model = particle_on(floor_collider(0.5));
  model.masses = Eigen::VectorXd::Constant(3, 0.01);
  model.gravity = Vec3::Zero();
  model.springs = {{VertexId(0), VertexId(1), kStringStiffness, 1},
                   {VertexId(1), VertexId(2), kStringStiffness, 1}};
  model.pins = {Pin{VertexId(0), Vec3(-1, -0.1, 0), {}}, Pin{VertexId(2), Vec3(1, -0.1, 0), {}}};
  return model;
}

State string_state() {
  State state;
  state.positions.resize(3, 3);
  state.positions << -1, 0, 1, -0.1, 0, -0.1, 0, 0, 0;
  state.velocities = Positions::Zero(3, 3);
  return state;
}

/// A rope over a drum of radius 0.1 m with a load at either end [kg], the second the heavier. It is
/// as tight everywhere as when it slides, with the loads' acceleration [m/s^2] of Euler and
/// Eytelwein's formula.
struct RopeOverDrum {
  RopeOverDrum(double friction, const std::array<double, 2>& loads);

  ClothModel model;
  State state;
  double acceleration;
};

RopeOverDrum::RopeOverDrum(double friction, const std::array<double, 2>& loads)
    : model(particle_on(ball_collider(Vec3::Zero(), 0.1, friction))) {
  constexpr double kRadius = 0.1;
  constexpr int kLinks = 60;
  constexpr double kLink = 0.01;
  constexpr double kStiffness = 3e3;
  const double brake = std::exp(friction * M_PI);
  acceleration = 9.81 * (loads[1] - brake * loads[0]) / (loads[1] + brake * loads[0]);
  const double pull = loads[0] * (9.81 + acceleration);
  model.masses = Eigen::VectorXd::Constant(kLinks + 1, 1e-5);
  model.masses[0] = loads[0];
  model.masses[kLinks] = loads[1];
  state.positions.resize(3, kLinks + 1);
  state.velocities = Positions::Zero(3, kLinks + 1);
  const auto turn = [&](double i) {
    return std::clamp((i - kLinks / 2) * kLink / kRadius, -M_PI / 2, M_PI / 2);
  };
  for (int i = 0; i <= kLinks; ++i) {
    const double below = std::abs(i - kLinks / 2) * kLink - kRadius * std::abs(turn(i));
    state.positions.col(i) =
        Vec3(kRadius * std::sin(turn(i)), kRadius * std::cos(turn(i)) - below, 0);
  }
  for (int i = 0; i < kLinks; ++i) {
    const double tension = pull * std::exp(friction * (turn(i + 0.5) + M_PI / 2));
    const double length = (state.positions.col(i + 1) - state.positions.col(i)).norm();
    model.springs.push_back(
        {VertexId(i), VertexId(i + 1), kStiffness, length - tension / kStiffness});
  }
}

State state_at(const Vec3& position) { return {position, Positions::Zero(3, 1)}; }

void advance(Stepper& stepper, State& state, int from, int to) {
  for (int s = from; s < to; ++s) REQUIRE(stepper.advance(state, s * stepper.options().step).ok());
}

}  // namespace

TEST_CASE("contact: a particle leaves a smooth ball where cos = 2/3, with every stepper",
          "[contact]") {
  for (const MethodOptions& options : fine_methods()) {
    // A lone particle, which nothing but its hold resists, is freed late by the rounds.
    if (options.stepper == &steppers::kProjective) continue;
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
    "contact: where the response is uniform a particle rises as high as it fell, with every "
    "stepper",
    "[contact]") {
  for (const MethodOptions& options : fine_methods()) {
    CAPTURE(options.stepper->name);
    ClothModel model = particle_on(floor_collider(0));
    ContactOptions contact;
    contact.response = ContactResponse::uniform;
    model.contact->set_options(contact);
    const auto stepper = make_stepper(model, options);
    constexpr double kHeight = 0.2;
    State state = state_at({0, kHeight, 0});
    const double fall_time = std::sqrt(2 * kHeight / 9.81);
    const int n_fall = static_cast<int>(std::ceil(fall_time / options.step));
    advance(*stepper, state, 0, n_fall);
    CHECK(state.velocities(1, 0) > 0);
    double highest = 0;
    for (int s = n_fall; s < 2 * n_fall + 2; ++s) {
      advance(*stepper, state, s, s + 1);
      highest = std::max(highest, state.positions(1, 0));
    }
    CHECK(highest == Approx(kHeight).epsilon(0.01));
  }
}

TEST_CASE("contact: where the response is uniform friction is of twice the normal change",
          "[contact]") {
  ClothModel model = particle_on(floor_collider(0.25));
  ContactOptions contact;
  contact.response = ContactResponse::uniform;
  model.contact->set_options(contact);
  model.gravity = Vec3::Zero();
  MethodOptions options;
  options.stepper = &steppers::kExplicitEuler;
  options.step = 0.01;
  const auto stepper = make_stepper(model, options);
  State state = state_at({0, 0.005, 0});
  state.velocities.col(0) = Vec3(3, -1, 0);
  advance(*stepper, state, 0, 1);
  // Half of the path is left after the impact, of which 3 - 0.25 * 2 are as fast as before.
  CHECK((state.velocities.col(0) - Vec3(2.5, 1, 0)).norm() < 1e-12);
  CHECK((state.positions.col(0) - Vec3(0.005 * 3 + 0.005 * 2.5, 0.005, 0)).norm() < 1e-12);
}

// A free particle falls by g (h^2 n (n + 1) / 2 + n h h' + h'^2) in n substeps of h and one of h',
// with every method of first order alike.
TEST_CASE("contact: first contact is within 1 um of where a free fall meets the solid",
          "[contact]") {
  constexpr double kHeight = 0.25;
  constexpr double kTolerance = 1e-6;
  for (const StepperType* type :
       {&steppers::kExplicitEuler, &steppers::kRk4, &steppers::kImplicitEuler, &steppers::kImex}) {
    CAPTURE(type->name);
    ClothModel model = particle_on(ball_collider(Vec3(0, -1, 0), 1, 0.3));
    MethodOptions options = type->usual_method();
    options.step = 1.0 / 60;
    options.substeps = 3;
    options.first_contact = kTolerance;
    const auto stepper = make_stepper(model, options);
    State state = state_at({0, kHeight, 0});
    for (int s = 0; s < 20; ++s) {
      CHECK_FALSE(stepper->first_contact().has_value());
      advance(*stepper, state, s, s + 1);
      if (stepper->first_contact()) break;
    }
    REQUIRE(stepper->first_contact().has_value());
    const double time = *stepper->first_contact();
    const double h = options.step / options.substeps;
    const double n = std::floor(time / h);
    const double rest = time - n * h;
    const double fallen = type == &steppers::kRk4
                              ? 9.81 * time * time / 2
                              : 9.81 * (h * h * n * (n + 1) / 2 + n * h * rest + rest * rest);
    CHECK(fallen <= kHeight);
    CHECK(fallen >= kHeight - kTolerance);
    if (type == &steppers::kRk4)
      CHECK(std::abs(time - std::sqrt(2 * kHeight / 9.81)) < kTolerance / (9.81 * time));
  }
}

TEST_CASE("contact: looking for first contact changes nothing before it, nor cloth that rests",
          "[contact]") {
  MethodOptions options;
  options.step = 0.01;
  const bool rests = GENERATE(false, true);
  const auto end = [&](double first_contact) {
    ClothModel model = particle_on(floor_collider(0.3));
    options.first_contact = first_contact;
    const auto stepper = make_stepper(model, options);
    State state = state_at({0, rests ? 0.0 : 0.1, 0});
    advance(*stepper, state, 0, 10);
    CHECK(stepper->first_contact().has_value() == (rests && first_contact > 0));
    return state;
  };
  const State with = end(1e-6);
  const State without = end(0);
  CHECK(with.positions == without.positions);
  CHECK(with.velocities == without.velocities);
}

TEST_CASE("contact: looking for first contact keeps the forces that cloth was carried over with",
          "[contact]") {
  MethodOptions options = GENERATE(&steppers::kImplicitEuler, &steppers::kImex)->usual_method();
  options.step = 0.01;
  options.substeps = 1;
  ClothModel model = string_over_floor();
  State state = string_state();
  const auto before = make_stepper(model, options);
  advance(*before, state, 0, 40);
  options.first_contact = 1e-6;
  const auto stepper = make_stepper(model, options);
  stepper->start_from_contact_forces(before->contact_forces());
  advance(*stepper, state, 40, 41);
  CHECK(stepper->first_contact().has_value());
  CHECK(stepper->contact_forces()(1, 1) == Approx(before->contact_forces()(1, 1)).epsilon(1e-6));
}

// Two particles, one over the other on a stiff spring, fall on a floor without weight. What is left
// of the parted substep is a hundredth of it, and the force that ends the fall there a hundred
// times that of a whole one.
TEST_CASE("contact: first contact late in a substep throws nothing back", "[contact]") {
  MethodOptions options = GENERATE(&steppers::kImplicitEuler, &steppers::kImex)->usual_method();
  options.step = 0.001;
  options.substeps = 1;
  options.first_contact = 1e-6;
  ClothModel model = particle_on(floor_collider(0.3));
  model.masses = Eigen::VectorXd::Constant(2, 0.001);
  model.gravity = Vec3::Zero();
  model.springs = {{VertexId(0), VertexId(1), 1e4, 1}};
  State state;
  state.positions.resize(3, 2);
  state.positions << 0, 0, 0.00999, 1.00999, 0, 0;
  state.velocities = Vec3(0, -1, 0).replicate(1, 2);
  const auto stepper = make_stepper(model, options);
  for (int s = 0; s < 20; ++s) {
    advance(*stepper, state, s, s + 1);
    CHECK(state.velocities.cwiseAbs().maxCoeff() <= 1 + 1e-6);
  }
  CHECK(*stepper->first_contact() == Approx(0.00999).margin(1e-6));
}

TEST_CASE("contact: steppers find in substeps with what force a floor holds a stiff string up",
          "[contact]") {
  struct Search {
    const StepperType* type;
    int n_substeps;  // projective takes a tenth of the others' stride
  };
  const Search search =
      GENERATE(Search{&steppers::kImplicitEuler, 40}, Search{&steppers::kImex, 40},
               Search{&steppers::kNewton, 40}, Search{&steppers::kProjective, 400});
  CAPTURE(search.type->name);
  ClothModel model = string_over_floor();
  State state = string_state();
  MethodOptions options = search.type->usual_method();
  options.step = 0.01;
  options.substeps = 1;
  const auto stepper = make_stepper(model, options);
  advance(*stepper, state, 0, search.n_substeps);
  const double length = std::hypot(1, 0.1);
  CHECK(std::abs(state.positions(1, 1)) < 1e-12);
  CHECK(stepper->contact_forces()(1, 1) ==
        Approx(2 * kStringStiffness * (length - 1) * 0.1 / length).epsilon(1e-6));
}

/// Steppers that solve for the end of a substep, as a scene of cloth would run them.
std::vector<MethodOptions> holding_methods(double step) {
  std::vector<MethodOptions> methods;
  for (const StepperType* type :
       {&steppers::kImplicitEuler, &steppers::kImex, &steppers::kNewton, &steppers::kProjective}) {
    methods.push_back(type->usual_method());
    methods.back().step = step;
    methods.back().substeps = 1;
  }
  return methods;
}

TEST_CASE("contact: a sheet slides down a slope as a block does, or stays", "[contact]") {
  constexpr double kFriction = 0.3;
  for (const MethodOptions& options : holding_methods(1.0 / 240))
    for (const double slope : {0.25, 0.5}) {
      CAPTURE(options.stepper->name, slope);
      const QuadMesh mesh = lying_sheet(6);
      ClothModel model = sheet_model(mesh, library_fabric("fine cotton"));
      model.contact.emplace(std::vector<Collider>{floor_collider(kFriction)}, ContactOptions{});
      model.gravity = 9.81 * Vec3(std::sin(slope), -std::cos(slope), 0);
      State state = rest_state(mesh);
      state.positions.row(2) = -state.positions.row(1);
      state.positions.row(1).setZero();
      const auto stepper = make_stepper(model, options);
      advance(*stepper, state, 0, 120);
      const Vec3 velocity = state.velocities.rowwise().mean();
      if (std::tan(slope) < kFriction)
        CHECK(state.velocities.norm() < 1e-9);
      else
        CHECK(velocity.x() ==
              Approx(9.81 * 0.5 * (std::sin(slope) - kFriction * std::cos(slope))).epsilon(0.02));
    }
}

// The normal is no axis, so that rounding leaves a little of every force across it.
TEST_CASE("contact: a smooth sheet slides down a slanted plane as g t sin a", "[contact]") {
  const double slope = GENERATE(0.1, 0.35, 1.2);
  const int cells = GENERATE(2, 8);
  for (const MethodOptions& options : holding_methods(1.0 / 240)) {
    CAPTURE(options.stepper->name, slope, cells);
    const QuadMesh mesh = lying_sheet(cells);
    ClothModel model = sheet_model(mesh, library_fabric("fine cotton"));
    const Vec3 normal(std::sin(slope), std::cos(slope), 0);
    Collider plane = floor_collider(0);
    plane.shape = Plane{Vec3::Zero(), normal};
    model.contact.emplace(std::vector<Collider>{plane}, ContactOptions{});
    model.gravity = {0, -9.81, 0};
    const Vec3 down(normal.y(), -normal.x(), 0);
    State state = rest_state(mesh);
    state.positions =
        down * mesh.rest_positions().row(0) + Vec3::UnitZ() * mesh.rest_positions().row(1);
    const auto stepper = make_stepper(model, options);
    advance(*stepper, state, 0, 120);
    CHECK(down.dot(state.velocities.rowwise().mean()) ==
          Approx(9.81 * 0.5 * std::sin(slope)).epsilon(0.001));
  }
}

TEST_CASE("contact: a rope over a drum is braked by the friction of its turn", "[contact]") {
  for (const MethodOptions& options : holding_methods(1.0 / 960))
    for (const double friction : {0.0, 0.2}) {
      // Projective needs more rounds than it has for so stiff a rope.
      if (options.stepper == &steppers::kProjective) continue;
      CAPTURE(options.stepper->name, friction);
      RopeOverDrum rope(friction, {0.01, 0.03});
      const auto stepper = make_stepper(rope.model, options);
      constexpr int kSteps = 120;
      advance(*stepper, rope.state, 0, kSteps);
      const double time = kSteps * options.step;
      CHECK(-rope.state.velocities(1, rope.state.velocities.cols() - 1) ==
            Approx(rope.acceleration * time).epsilon(0.06));
    }
}

}  // namespace pleat
