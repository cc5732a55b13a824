#include <catch2/catch.hpp>
#include <cmath>

#include "core/dynamics/stepper_table.h"
#include "native-tests/support/bodies.h"

namespace pleat {
namespace {

constexpr double kBodyGap = 5e-4;  // gap that cloth rests at [m]
constexpr double kFall = 9.81;     // [m/s^2]
constexpr double kRise = 0.2;      // half the height of the box [m]

/// A stiff square of cloth of 0.1 m above the upper side of a wide box that is tilted about z.
struct Sliding {
  ClothModel model;
  State state;
  Vec3 along, up;  // directions down the slope, and off it

  Sliding(double angle, double friction, double height)
      : along(std::cos(angle), -std::sin(angle), 0), up(std::sin(angle), std::cos(angle), 0) {
    model.masses = Eigen::VectorXd::Constant(4, 1e-3);
    model.gravity = {0, -kFall, 0};
    state.positions.resize(3, 4);
    state.velocities = Positions::Zero(3, 4);
    const std::array<Vec3, 4> square = {Vec3(0.013, 0, 0.021), Vec3(0.113, 0, 0.021),
                                        Vec3(0.113, 0, 0.121), Vec3(0.013, 0, 0.121)};
    for (int k = 0; k < 4; ++k) {
      const Vec3& corner = square[static_cast<std::size_t>(k)];
      state.positions.col(k) =
          corner.x() * along + (kRise + height) * up + corner.z() * Vec3::UnitZ();
      for (int m = 0; m < k; ++m)
        model.springs.push_back(
            {VertexId(m), VertexId(k), 1e4, (corner - square[static_cast<std::size_t>(m)]).norm()});
    }
    model.self_contact.emplace();
    SelfContact& contact = *model.self_contact;
    contact.faces = {{VertexId(0), VertexId(1), VertexId(2)},
                     {VertexId(0), VertexId(2), VertexId(3)}};
    contact.rest_positions = state.positions;
    contact.thickness = 2 * kBodyGap;
    contact.body_gap = kBodyGap;
    contact.is_loose = true;
    contact.bodies = {box_body({0, 0, 0}, {6, 2 * kRise, 1}, along, up)};
    contact.bodies[0].friction = friction;
  }

  BodySurface& box() { return model.self_contact->bodies[0]; }

  void run(const char* name, int n_steps) {
    MethodOptions method = find_stepper(standard_steppers(), name)->usual_method();
    method.step = 1.0 / 240;
    const auto stepper = make_stepper(model, method);
    for (int s = 0; s < n_steps; ++s) REQUIRE_FALSE(stepper->advance(state, s / 240.0).ends_run());
  }
};

}  // namespace

TEST_CASE("cloth_bodies: cloth that falls on a box comes to rest at the gap", "[dynamics]") {
  const char* const stepper = GENERATE("implicit", "xpbd");
  Sliding lying(0, 0.3, 0.02);
  lying.run(stepper, 240);
  CHECK(lying.state.positions.row(1).maxCoeff() - kRise == Approx(kBodyGap).epsilon(0.02));
  CHECK(lying.state.positions.row(1).minCoeff() - kRise == Approx(kBodyGap).epsilon(0.02));
  CHECK(lying.state.velocities.cwiseAbs().maxCoeff() < 1e-4);
}

TEST_CASE("cloth_bodies: on a tilted box cloth holds below the angle of friction", "[dynamics]") {
  const char* const stepper = GENERATE("implicit", "xpbd");
  const double friction = GENERATE(0.2, 0.6);
  Sliding lying(std::atan(0.99 * friction), friction, kBodyGap);
  const Positions start = lying.state.positions;
  lying.run(stepper, 240);
  CHECK((lying.state.positions - start).colwise().norm().maxCoeff() < 1e-4);
}

TEST_CASE("cloth_bodies: above it cloth slides down a box as Coulomb's law says", "[dynamics]") {
  const char* const stepper = GENERATE("implicit", "xpbd");
  const double friction = GENERATE(0.0, 0.2, 0.6);
  const double angle = std::atan(1.2 * friction + 0.1);
  Sliding sliding(angle, friction, kBodyGap);
  const Positions start = sliding.state.positions;
  const int n_steps = 120;
  sliding.run(stepper, n_steps);
  const double time = n_steps / 240.0;
  const double way = sliding.along.dot((sliding.state.positions - start).rowwise().mean());
  const double acceleration = kFall * (std::sin(angle) - friction * std::cos(angle));
  CHECK(way == Approx(acceleration * time * time / 2).epsilon(0.02));
}

TEST_CASE("cloth_bodies: what body and cloth do in common changes nothing", "[dynamics]") {
  const char* const stepper = GENERATE("implicit", "newton");
  const Vec3 velocity(3, -1, 7);
  const int n_steps = 120;
  const double time = n_steps / 240.0;
  // Rounding decides in each substep whether a slide at the edge of Coulomb's cone holds.
  const auto [friction, difference] =
      GENERATE(table<double, double>({{0, 1e-9}, {2, 1e-9}, {0.2, 1e-4}}));
  CAPTURE(stepper, friction);
  Sliding still(0.3, friction, 0.01);
  Sliding moving(0.3, friction, 0.01);
  moving.state.velocities.colwise() = velocity;
  moving.box().motion.kind = Motion::Kind::move;
  moving.box().motion.offset = 10 * velocity;
  moving.box().motion.time_end = 10;
  still.run(stepper, n_steps);
  moving.run(stepper, n_steps);
  const Positions back = moving.state.positions.colwise() - time * velocity;
  CHECK((back - still.state.positions).colwise().norm().maxCoeff() < difference);
}

TEST_CASE("cloth_bodies: a turning box carries cloth that sticks to it", "[dynamics]") {
  const char* const stepper = GENERATE("implicit", "xpbd");
  constexpr double kRate = 1;  // [rad/s]
  Sliding lying(0, 2, kBodyGap);
  lying.state.velocities.row(0) = kRate * lying.state.positions.row(2);
  lying.state.velocities.row(2) = -kRate * lying.state.positions.row(0);
  const Positions start = lying.state.positions;
  lying.box().motion.kind = Motion::Kind::follow;
  lying.box().motion.frame = std::make_shared<Spin>(Vec3::UnitY(), kRate);
  const int n_steps = 240;
  lying.run(stepper, n_steps);
  const Pose pose = lying.box().motion.pose(n_steps / 240.0);
  CHECK((lying.state.positions - pose.rotation * start).colwise().norm().maxCoeff() < 2e-3);
}

TEST_CASE("cloth_bodies: a box that rises lifts cloth, however fast", "[dynamics]") {
  const char* const stepper = GENERATE("implicit", "xpbd", "explicit");
  const double speed = GENERATE(1.0, 30.0);
  Sliding lifted(0, 0.3, 0.01);
  for (Spring& spring : lifted.model.springs) spring.stiffness = 20;
  lifted.box().motion.kind = Motion::Kind::move;
  lifted.box().motion.offset = {0, speed, 0};
  lifted.box().motion.time_end = 1;
  lifted.run(stepper, 120);
  const double top = kRise + 0.5 * speed;
  CHECK(lifted.state.positions.row(1).minCoeff() > top);
}

}  // namespace pleat
