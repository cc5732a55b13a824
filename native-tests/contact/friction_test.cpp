#include "core/contact/contact_pass.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "native-tests/support/particle.h"

namespace pleat {
namespace {}  // namespace

// Falling 0.1 m at 4 m/s takes 1/4 of the substep; friction 0.5 then takes 2 of the 5 m/s along the
// floor.
TEST_CASE("contact: friction shortens the path after the impact only", "[contact]") {
  ContactPass pass({floor_collider(0.5)}, {});
  pass.begin_substep(0, 0.1);
  const Vec3 begin{0, 0.1, 0};
  Vec3 velocity{5, -4, 0};
  Vec3 position = begin + 0.1 * velocity;
  CHECK(resolve(pass, VertexId(0), begin, position, velocity));
  CHECK((velocity - Vec3(3, 0, 0)).norm() < 1e-14);
  CHECK((position - Vec3(0.025 * 5 + 0.075 * 3, 0, 0)).norm() < 1e-14);
}

TEST_CASE("contact: a block on an incline accelerates by g (sin t - mu cos t)", "[contact]") {
  const double h = GENERATE(1.0 / 30, 1.0 / 240, 1.0 / 3000);
  const double slope = GENERATE(0.4, 0.9);  // [rad]
  const double friction = GENERATE(0.0, 0.3);
  CAPTURE(h, slope, friction);
  Collider incline = floor_collider(friction);
  const Vec3 downhill(std::cos(slope), -std::sin(slope), 0);
  incline.shape = Plane{Vec3::Zero(), Vec3(std::sin(slope), std::cos(slope), 0)};
  ContactPass pass({incline}, {});
  Particle block{Vec3::Zero(), Vec3::Zero()};
  const int n_steps = static_cast<int>(std::lround(2 / h));
  for (int k = 0; k < n_steps; ++k) step(pass, -kGravity * kUp, k * h, h, block);
  const double acceleration = kGravity * (std::sin(slope) - friction * std::cos(slope));
  CHECK((block.velocity - 2 * acceleration * downhill).norm() < 1e-10);
  // Symplectic Euler sums h v over the ends of the steps: a t (t + h) / 2.
  CHECK((block.position - 0.5 * acceleration * 2 * (2 + h) * downhill).norm() < 1e-10);
}

TEST_CASE("contact: below the friction angle nothing creeps", "[contact]") {
  const double h = GENERATE(1.0 / 30, 1.0 / 240, 1.0 / 6000);
  const double slope = GENERATE(0.0, 0.1, 0.28);  // [rad]; atan 0.3 = 0.2915
  CAPTURE(h, slope);
  Collider incline = floor_collider(0.3);
  incline.shape = Plane{{0.1, 0.2, 0.3}, Vec3(std::sin(slope), std::cos(slope), 0)};
  ContactPass pass({incline}, {0.0005, {}});
  const Plane plane = std::get<Plane>(incline.shape);
  const Vec3 start = plane.point + 0.0005 * plane.normal + Vec3(0, 0, 0.7);
  Particle block{start, Vec3::Zero()};
  const int n_steps = static_cast<int>(std::lround(10 / h));
  for (int k = 0; k < n_steps; ++k) step(pass, -kGravity * kUp, k * h, h, block);
  CHECK(block.velocity == Vec3(0, 0, 0));
  CHECK((block.position - start).norm() < 1e-15);
}

TEST_CASE("contact: friction obeys Coulomb's bound and never adds energy", "[contact]") {
  Random random(9);
  for (int trial = 0; trial < 300; ++trial) {
    const double friction = random.uniform(0, 1.5);
    Collider ball = ball_collider({0, 0, 0}, 0.5, friction);
    const Vec3 velocity_of_ball = 3 * random_direction(random);
    ball.motion = steady_motion(velocity_of_ball);
    ContactPass pass({ball}, {});
    pass.begin_substep(0, 0.1);
    const Vec3 side = random_direction(random);
    const Vec3 begin = 0.6 * side;
    const Vec3 velocity_before = velocity_of_ball + 5 * (random_direction(random) - side);
    Vec3 position = begin + 0.1 * velocity_before;
    Vec3 velocity = velocity_before;
    if (!resolve(pass, VertexId(0), begin, position, velocity)) continue;
    // The change is in the plane of normal and slip; its normal part is what stopped the approach.
    const SweptSphere swept{0.1 * velocity_of_ball, 0.5, 0.1 * velocity_of_ball};
    const Vec3 normal = first_impact(swept, begin, begin + 0.1 * velocity_before, 0)->normal;
    const Vec3 change = velocity - velocity_before;
    const double normal_change = change.dot(normal);
    CHECK(normal_change >= 0);
    CHECK((change - normal_change * normal).norm() <=
          friction * normal_change * (1 + 1e-12) + 1e-14);
    CHECK((velocity - velocity_of_ball).norm() <=
          (velocity_before - velocity_of_ball).norm() * (1 + 1e-14));
    CHECK((velocity - velocity_of_ball).dot(normal) == Approx(0).margin(1e-14));
  }
}

TEST_CASE("contact: a belt drags by mu g until the vertex rides along", "[contact]") {
  const double h = GENERATE(1.0 / 60, 1.0 / 1000);
  Collider belt = floor_collider(0.4);
  belt.motion = steady_motion({2, 0, 0});
  ContactPass pass({belt}, {});
  Particle particle{{0, 0, 0}, {0, 0, 0}};
  const int n_slip = static_cast<int>(std::lround(0.4 / h));  // it rides after 2 / (0.4 g) = 0.51 s
  for (int k = 0; k < n_slip; ++k) step(pass, -kGravity * kUp, k * h, h, particle);
  CHECK(particle.velocity.x() == Approx(0.4 * kGravity * n_slip * h).epsilon(1e-10));
  const int n_ride = static_cast<int>(std::lround(0.6 / h));
  for (int k = n_slip; k < n_ride; ++k) step(pass, -kGravity * kUp, k * h, h, particle);
  CHECK((particle.velocity - Vec3(2, 0, 0)).norm() < 1e-12);
  const double x = particle.position.x();
  for (int k = n_ride; k < 2 * n_ride; ++k) step(pass, -kGravity * kUp, k * h, h, particle);
  CHECK(particle.position.x() - x == Approx(2 * n_ride * h).epsilon(1e-10));
}

TEST_CASE("contact: a ball moving sideways drags what lies on it", "[contact]") {
  Collider ball = ball_collider({0, -0.5, 0}, 0.5, 0.4);
  ball.motion = steady_motion({0.05, 0, 0});
  ContactPass pass({ball}, {});
  Particle particle{{0, 0, 0}, {0, 0, 0}};
  const double h = 1.0 / 1000;
  for (int k = 0; k < 200; ++k) step(pass, -kGravity * kUp, k * h, h, particle);
  CHECK((particle.velocity - Vec3(0.05, 0, 0)).norm() < 1e-4);
}

// Energy and the centripetal force part a frictionless vertex from a sphere where cos = 2/3.
TEST_CASE("contact: a vertex leaves a smooth ball at the angle acos 2/3", "[contact]") {
  const auto leaving_cosine = [](double h) {
    ContactPass pass({ball_collider({0, 0, 0}, 1, 0)}, {});
    Particle particle{{std::sin(0.05), std::cos(0.05), 0}, {0, 0, 0}};
    double cosine = 1;
    for (int k = 0; particle.position.y() > 0; ++k) {
      const Vec3 begin = particle.position;
      if (step(pass, -kGravity * kUp, k * h, h, particle)) cosine = begin.normalized().y();
    }
    return cosine;
  };
  const double exact = 2.0 / 3 * std::cos(0.05);  // starts from rest at 0.05 rad
  const double error_coarse = std::abs(leaving_cosine(1e-3) - exact);
  const double error_fine = std::abs(leaving_cosine(1e-4) - exact);
  CAPTURE(error_coarse, error_fine);
  // The contact force fades to nothing at the angle, so the last touch is known to about the root
  // of the step.
  CHECK(error_fine < 0.4 * error_coarse);
  CHECK(error_fine < 2e-3);
}

// It goes round a ball of 1 m on the surface, so that its way's chord is inside.
TEST_CASE("contact: the solid on which a vertex is settled leaves it alone, others do not",
          "[contact]") {
  const bool has_wall = GENERATE(false, true);
  std::vector<Collider> solids = {ball_collider(Vec3::Zero(), 1, 0.5)};
  if (has_wall) {
    solids.push_back(floor_collider(0));
    solids.back().shape = Plane{Vec3(0.05, 0, 0), Vec3(-1, 0, 0)};
  }
  ContactPass pass(solids, {});
  pass.begin_substep(0, 0.1);
  const Vec3 begin(0, 1, 0);
  const Vec3 end(std::sin(0.1), std::cos(0.1), 0);
  const auto met = pass.first_met(VertexId(0), begin, end);
  REQUIRE(met.has_value());
  CHECK(met->solid == 0);
  CHECK((met->normal - Vec3(0, 1, 0)).norm() < 1e-12);
  CHECK_FALSE(pass.first_met(VertexId(0), begin, begin + Vec3(0, 0.1, 0)).has_value());
  const Vec3 inside(0, 0.9, 0);
  CHECK_FALSE(pass.first_met(VertexId(0), inside, inside).has_value());
  const ContactPass::Touch settled{VertexId(0), 0, end};
  Positions positions = end;
  Positions velocities = Vec3(std::cos(0.1), -std::sin(0.1), 0);
  const Positions before = velocities;
  const std::vector<char> none(1, 0);
  const auto touches =
      pass.resolve(Positions(begin), none, positions, velocities, std::span(&settled, 1));
  REQUIRE(touches.size() == 1);
  CHECK(touches[0].in_corner == has_wall);
  if (has_wall) {
    CHECK(positions(0, 0) <= 0.05);
    CHECK(velocities(0, 0) <= 0);
    CHECK(positions.norm() >= 1 - 1e-12);
  } else {
    CHECK(positions.col(0) == end);
    CHECK(velocities == before);
  }
}

}  // namespace pleat
