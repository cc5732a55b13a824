#include "core/dynamics/contact_rounds.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/dynamics/stepper_table.h"
#include "native-tests/support/models.h"
#include "native-tests/support/particle.h"

namespace pleat {
namespace {

constexpr double kRoundsStep = 0.01;  // [s]

struct TouchingCloth {
  ClothModel model;
  State state;
};

Collider table(double friction) {
  Collider collider = floor_collider(friction);
  collider.shape = Plane{Vec3::Zero(), Vec3::UnitZ()};
  return collider;
}

/// In the plane z = 0, with a weight that has a part along x.
TouchingCloth sheet_on(const Collider& collider, const Vec3& gravity, const std::string& fabric) {
  const QuadMesh mesh = lying_sheet(8);
  TouchingCloth cloth{sheet_model(mesh, library_fabric(fabric)), rest_state(mesh)};
  cloth.model.gravity = gravity;
  cloth.model.contact.emplace(std::vector<Collider>{collider}, ContactOptions{});
  return cloth;
}

MethodOptions by_rounds(int n_rounds, Acceleration acceleration = Acceleration::none) {
  MethodOptions options;
  options.stepper = &steppers::kProjective;
  options.step = kRoundsStep;
  options.solver = SolverKind::eigen;
  options.iterations = n_rounds;
  options.acceleration = acceleration;
  return options;
}

void advance_by_rounds(Stepper& stepper, State& state, int from, int to) {
  for (int s = from; s < to; ++s) REQUIRE(stepper.advance(state, s * stepper.options().step).ok());
}

double stretch_of_springs(const TouchingCloth& cloth) {
  double sum = 0;
  for (const Spring& spring : cloth.model.springs) {
    const Vec3 d = cloth.state.positions.col(spring.a) - cloth.state.positions.col(spring.b);
    sum += std::pow(d.norm() / spring.rest_length - 1, 2);
  }
  return std::sqrt(sum / static_cast<double>(cloth.model.springs.size()));
}

/// A sheet that falls on a solid, without air, for 1 s.
struct Drape {
  double stretch = 0;              // root mean square, its mean over time
  double least_height = INFINITY;  // above the solid [m]
};

constexpr double kBallRadius = 0.25;  // [m]

Drape drape(const std::string& fabric, const Collider& solid, MethodOptions options) {
  const QuadMesh mesh = lying_sheet(16);
  TouchingCloth cloth{sheet_model(mesh, library_fabric(fabric)), rest_state(mesh)};
  cloth.model.gravity = {0, 0, -9.81};
  cloth.model.contact.emplace(std::vector<Collider>{solid}, ContactOptions{});
  options.step = 1.0 / 60;
  const auto stepper = make_stepper(cloth.model, options);
  Drape drape;
  constexpr int kSteps = 60;
  for (int s = 0; s < kSteps; ++s) {
    advance_by_rounds(*stepper, cloth.state, s, s + 1);
    drape.stretch += stretch_of_springs(cloth) / kSteps;
    for (int i = 0; i < cloth.model.n_vertices(); ++i)
      drape.least_height = std::min(
          drape.least_height, height(solid, cloth.state.positions.col(i), (s + 1) * options.step));
  }
  return drape;
}

}  // namespace

TEST_CASE("contact rounds: cloth on a slope stays below the friction angle and slides above it",
          "[contact]") {
  const double angle = GENERATE(0.3, 0.5);
  const double friction = GENERATE(0.2, 0.4);
  const auto acceleration = GENERATE(Acceleration::none, Acceleration::anderson);
  CAPTURE(angle, friction, acceleration);
  const Vec3 gravity = 9.81 * Vec3(std::sin(angle), 0, -std::cos(angle));
  TouchingCloth cloth = sheet_on(table(friction), gravity, "linen");
  const Positions begin = cloth.state.positions;
  const auto stepper = make_stepper(cloth.model, by_rounds(10, acceleration));
  constexpr int kSteps = 50;
  advance_by_rounds(*stepper, cloth.state, 0, kSteps);
  const double slide = 9.81 * std::max(std::sin(angle) - friction * std::cos(angle), 0.0);
  Positions expected = begin;
  expected.row(0).array() += slide * kRoundsStep * kRoundsStep * kSteps * (kSteps + 1) / 2;
  // Rounding of places, over the step and made larger by the springs' stiffness.
  CHECK((cloth.state.positions - expected).cwiseAbs().maxCoeff() < 1e-7);
  CHECK((cloth.state.velocities.row(0).array() - slide * kRoundsStep * kSteps).abs().maxCoeff() <
        1e-6);
  CHECK((cloth.state.velocities.bottomRows(2)).cwiseAbs().maxCoeff() < 1e-6);
  const Vec3 reaction(-9.81 * std::min(std::sin(angle), friction * std::cos(angle)), 0,
                      9.81 * std::cos(angle));
  CHECK((stepper->contact_forces().rowwise().sum() / cloth.model.masses.sum() - reaction).norm() <
        1e-6);
}

TEST_CASE("contact rounds: a sheet that comes down flat rests in the step in which it does",
          "[contact]") {
  TouchingCloth cloth = sheet_on(table(0.3), {0, 0, -9.81}, "linen");
  cloth.state.positions.row(2).array() += 0.005;
  cloth.state.velocities.row(2).setConstant(-1);
  const Positions begin = cloth.state.positions;
  const auto stepper = make_stepper(cloth.model, by_rounds(10));
  for (int s = 0; s < 20; ++s) {
    advance_by_rounds(*stepper, cloth.state, s, s + 1);
    CHECK(cloth.state.velocities.cwiseAbs().maxCoeff() < 1e-9);
    CHECK(cloth.state.positions.row(2).cwiseAbs().maxCoeff() < 1e-12);
    CHECK((cloth.state.positions - begin).topRows(2).cwiseAbs().maxCoeff() < 1e-9);
  }
}

TEST_CASE("contact rounds: cloth that has rested leaves as if nothing had held it", "[contact]") {
  const auto acceleration = GENERATE(Acceleration::none, Acceleration::anderson);
  TouchingCloth cloth = sheet_on(table(0.3), {0, 0, -9.81}, "linen");
  const auto stepper = make_stepper(cloth.model, by_rounds(10, acceleration));
  advance_by_rounds(*stepper, cloth.state, 0, 20);
  const Positions begin = cloth.state.positions;
  cloth.model.gravity = {0, 0, 9.81};
  constexpr int kSteps = 10;
  advance_by_rounds(*stepper, cloth.state, 20, 20 + kSteps);
  Positions expected = begin;
  expected.row(2).array() += 9.81 * kRoundsStep * kRoundsStep * kSteps * (kSteps + 1) / 2;
  CHECK((cloth.state.positions - expected).cwiseAbs().maxCoeff() < 1e-9);
  CHECK(stepper->contact_forces().isZero(0));
}

TEST_CASE("contact rounds: a solid out of reach changes no bit", "[contact]") {
  const auto acceleration = GENERATE(Acceleration::none, Acceleration::anderson);
  const auto end = [&](bool has_solid) {
    TouchingCloth cloth = sheet_on(table(0.3), {0, 0, -9.81}, "linen");
    if (!has_solid) cloth.model.contact.reset();
    cloth.state.positions.row(2).array() += 10;
    cloth.state.velocities(2, 3) = 5;
    advance_by_rounds(*make_stepper(cloth.model, by_rounds(10, acceleration)), cloth.state, 0, 10);
    return cloth.state;
  };
  CHECK(end(true).positions == end(false).positions);
  CHECK(end(true).velocities == end(false).velocities);
}

TEST_CASE("contact rounds: over a solid cloth stretches little more than implicit lets it",
          "[contact]") {
  struct Fall {
    Collider solid;
    double most;  // of implicit's stretch
    double most_accelerated;
  };
  const Collider ball = ball_collider(Vec3(0.5, 0.5, -0.3), kBallRadius, 0.3);
  const Collider smooth = ball_collider(Vec3(0.5, 0.5, -0.3), kBallRadius, 0);
  Collider moving = ball;
  moving.motion = steady_motion(Vec3(0.2, 0.1, 0.3));
  RoundedCone capsule;
  capsule.centre_a = {0.1, 0.5, -0.2};
  capsule.centre_b = {0.8, 0.4, -0.3};
  capsule.radius_a = capsule.radius_b = 0.15;
  // TouchingCloth lies on a capsule without being stretched: there implicit has half of the
  // stretch.
  const Fall fall = GENERATE_COPY(Fall{ball, 2, 2}, Fall{smooth, 2, 2}, Fall{moving, 2, 2},
                                  Fall{cone_collider(capsule, 0.2), 2.5, 3.5});
  const std::string fabric = GENERATE("linen", "fine cotton");
  const auto acceleration = GENERATE(Acceleration::none, Acceleration::anderson);
  CAPTURE(fabric, fall.solid.friction, fall.solid.shape.index(), acceleration);
  const Drape expected = drape(fabric, fall.solid, steppers::kImplicitEuler.usual_method());
  const Drape found = drape(fabric, fall.solid, by_rounds(10, acceleration));
  CAPTURE(expected.stretch, found.stretch);
  const bool is_plain = acceleration == Acceleration::none;
  CHECK(found.stretch < expected.stretch * (is_plain ? fall.most : fall.most_accelerated));
  CHECK(found.least_height > -kRoundingDepth);
}

}  // namespace pleat
