#include "core/contact/contact_stage.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/base/check.h"
#include "core/base/random.h"
#include "native-tests/support/allocation_count.h"

namespace pleat {
namespace {

constexpr double kGravity = 9.81;         // [m/s^2]
constexpr double kRoundingDepth = 1e-14;  // of coordinates near 1 m [m]
const Vec3 kUp{0, 1, 0};

struct Particle {
  Vec3 position;  // [m]
  Vec3 velocity;  // [m/s]
};

Collider floor_collider(double friction) {
  Collider collider;
  collider.shape = Plane{};
  collider.friction = friction;
  return collider;
}

Collider ball_collider(const Vec3& centre, double radius, double friction) {
  Collider collider;
  collider.shape = Sphere{centre, radius};
  collider.friction = friction;
  return collider;
}

Motion steady_motion(const Vec3& velocity) {
  constexpr double kLong = 1000;  // [s]
  Motion motion;
  motion.kind = Motion::Kind::move;
  motion.offset = kLong * velocity;
  motion.time_end = kLong;
  return motion;
}

Vec3 random_direction(Random& random) {
  Vec3 direction;
  do {
    direction = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  } while (direction.norm() < 0.1 || direction.norm() > 1);
  return direction.normalized();
}

/// How far a place is above the surface of the solid at a time, without clearance [m].
double height(const Collider& collider, const Vec3& place, double time) {
  const auto shape = ContactStage::placed(collider, time);
  if (const auto* plane = std::get_if<Plane>(&shape))
    return plane->normal.dot(place - plane->point);
  const auto& sphere = std::get<Sphere>(shape);
  return (place - sphere.centre).norm() - sphere.radius;
}

/// One step of symplectic Euler under an acceleration [m/s^2], contact included.
bool step(ContactStage& stage, const Vec3& acceleration, double time, double h,
          Particle& particle) {
  const Vec3 begin = particle.position;
  particle.velocity += h * acceleration;
  particle.position += h * particle.velocity;
  stage.begin_substep(time, time + h);
  return stage.resolve(begin, particle.position, particle.velocity);
}

}  // namespace

TEST_CASE("contact: a vertex that meets nothing is left to the bit", "[contact]") {
  ContactStage stage({floor_collider(0.3), ball_collider({0, 5, 0}, 1, 0.3)}, {});
  stage.begin_substep(0, 1);
  const Vec3 begin{0.1, 1, 0.2};
  Vec3 position{0.7, 0.3, -0.4};
  Vec3 velocity = position - begin;
  CHECK_FALSE(stage.resolve(begin, position, velocity));
  CHECK(position == Vec3(0.7, 0.3, -0.4));
  CHECK(velocity == Vec3(0.7, 0.3, -0.4) - begin);
}

TEST_CASE("contact: without friction an impact keeps the tangential motion", "[contact]") {
  ContactStage stage({floor_collider(0)}, {0.01, 0});
  stage.begin_substep(0, 0.1);
  const Vec3 begin{0, 0.11, 0};
  Vec3 velocity{3, -4, 1};
  Vec3 position = begin + 0.1 * velocity;
  CHECK(stage.resolve(begin, position, velocity));
  CHECK((position - Vec3(0.3, 0.01, 0.1)).norm() < 1e-15);
  CHECK((velocity - Vec3(3, 0, 1)).norm() < 1e-15);
}

// Falling 0.1 m at 4 m/s takes 1/4 of the substep; friction 0.5 then takes 2 of the 5 m/s along the
// floor.
TEST_CASE("contact: friction shortens the path after the impact only", "[contact]") {
  ContactStage stage({floor_collider(0.5)}, {});
  stage.begin_substep(0, 0.1);
  const Vec3 begin{0, 0.1, 0};
  Vec3 velocity{5, -4, 0};
  Vec3 position = begin + 0.1 * velocity;
  CHECK(stage.resolve(begin, position, velocity));
  CHECK((velocity - Vec3(3, 0, 0)).norm() < 1e-14);
  CHECK((position - Vec3(0.025 * 5 + 0.075 * 3, 0, 0)).norm() < 1e-14);
}

TEST_CASE("contact: a plane is never penetrated at 50 m/s", "[contact]") {
  const double h = GENERATE(1.0 / 30, 1.0 / 240);
  const double speed_of_plane = GENERATE(0.0, 20.0);
  CAPTURE(h, speed_of_plane);
  Random random(4);
  for (int trial = 0; trial < 300; ++trial) {
    Collider wall = floor_collider(random.uniform(0, 1));
    const Vec3 normal = random_direction(random);
    wall.shape = Plane{0.3 * random_direction(random), normal};
    wall.motion = steady_motion(speed_of_plane * random_direction(random));
    ContactStage stage({wall}, {0.001, 0});
    Particle particle{std::get<Plane>(wall.shape).point + random.uniform(0.002, 0.5) * normal,
                      50 * random_direction(random)};
    for (int k = 0; k < 8; ++k) {
      step(stage, -kGravity * kUp, k * h, h, particle);
      REQUIRE(height(wall, particle.position, (k + 1) * h) >= 0.001 - 10 * kRoundingDepth);
    }
  }
}

TEST_CASE("contact: a sphere is never penetrated at 50 m/s", "[contact]") {
  const double h = GENERATE(1.0 / 30, 1.0 / 240);
  const double speed_of_sphere = GENERATE(0.0, 60.0);
  const double radius = GENERATE(0.02, 0.3);
  CAPTURE(h, speed_of_sphere, radius);
  Random random(5);
  int n_hits = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Collider ball = ball_collider(0.2 * random_direction(random), radius, random.uniform(0, 1));
    ball.motion = steady_motion(speed_of_sphere * random_direction(random));
    ContactStage stage({ball}, {});
    const Vec3 centre = std::get<Sphere>(ball.shape).centre;
    Particle particle{centre + random.uniform(1.01, 3) * radius * random_direction(random),
                      Vec3::Zero()};
    // Aimed past the centre by up to its radius and a little more: full, side, grazing and missed
    // hits.
    const Vec3 aim = centre + random.uniform(0, 1.1) * radius * random_direction(random);
    particle.velocity = 50 * (aim - particle.position).normalized();
    for (int k = 0; k < 4; ++k) {
      const Vec3 begin = particle.position;
      n_hits += step(stage, -kGravity * kUp, k * h, h, particle);
      REQUIRE(height(ball, particle.position, (k + 1) * h) >= -10 * kRoundingDepth);
      // Nor has the way there led through: seen from the sphere it is straight before and after the
      // correction.
      const Vec3 start = begin - ball.motion.displacement(k * h) - centre;
      const Vec3 way = particle.position - ball.motion.displacement((k + 1) * h) - centre - start;
      const double nearest =
          std::clamp(-start.dot(way) / std::max(way.squaredNorm(), 1e-300), 0.0, 1.0);
      REQUIRE((start + nearest * way).norm() >= radius - 10 * kRoundingDepth);
    }
  }
  CHECK(n_hits > 100);
}

// The first root of |a + s d| = r by bisection, as a second implementation.
TEST_CASE("contact: a sphere is met where bisection says", "[contact]") {
  Random random(6);
  const SweptSphere sphere{{0.1, 0.2, 0.3}, 0.5, {0.05, -0.1, 0.2}};
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 begin =
        sphere.centre - sphere.shift + random.uniform(0.51, 2) * random_direction(random);
    const Vec3 end = sphere.centre + 0.49 * random_direction(random);
    const Vec3 start = begin + sphere.shift - sphere.centre;
    const Vec3 path = end - begin - sphere.shift;
    double outside = 0;
    double inside = 1;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (outside + inside);
      ((start + middle * path).norm() > sphere.radius ? outside : inside) = middle;
    }
    const auto impact = first_impact(sphere, begin, end, 0);
    REQUIRE(impact);
    CHECK(impact->fraction == Approx(inside).margin(1e-12));
    CHECK((impact->point - sphere.centre).norm() == Approx(sphere.radius));
  }
}

TEST_CASE("contact: a block on an incline accelerates by g (sin t - mu cos t)", "[contact]") {
  const double h = GENERATE(1.0 / 30, 1.0 / 240, 1.0 / 3000);
  const double slope = GENERATE(0.4, 0.9);  // [rad]
  const double friction = GENERATE(0.0, 0.3);
  CAPTURE(h, slope, friction);
  Collider incline = floor_collider(friction);
  const Vec3 downhill(std::cos(slope), -std::sin(slope), 0);
  incline.shape = Plane{Vec3::Zero(), Vec3(std::sin(slope), std::cos(slope), 0)};
  ContactStage stage({incline}, {});
  Particle block{Vec3::Zero(), Vec3::Zero()};
  const int n_steps = static_cast<int>(std::lround(2 / h));
  for (int k = 0; k < n_steps; ++k) step(stage, -kGravity * kUp, k * h, h, block);
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
  ContactStage stage({incline}, {0.0005, 0});
  const Plane plane = std::get<Plane>(incline.shape);
  const Vec3 start = plane.point + 0.0005 * plane.normal + Vec3(0, 0, 0.7);
  Particle block{start, Vec3::Zero()};
  const int n_steps = static_cast<int>(std::lround(10 / h));
  for (int k = 0; k < n_steps; ++k) step(stage, -kGravity * kUp, k * h, h, block);
  CHECK(block.velocity == Vec3(0, 0, 0));
  CHECK((block.position - start).norm() < 1e-15);
}

TEST_CASE("contact: a vertex dropped on a floor comes to rest at once and stays", "[contact]") {
  ContactStage stage({floor_collider(0.3)}, {0.001, 0});
  Particle particle{{0.2, 0.5, 0.3}, {0.4, 0, 0}};
  const double h = 1.0 / 60;
  Vec3 settled = Vec3::Zero();
  for (int k = 0; k < 660; ++k) {
    step(stage, -kGravity * kUp, k * h, h, particle);
    if (k == 60) settled = particle.position;
    if (k >= 60) REQUIRE((particle.velocity == Vec3(0, 0, 0) && particle.position == settled));
  }
  CHECK(settled.y() == Approx(0.001).epsilon(1e-13));
}

TEST_CASE("contact: a vertex that begins inside is put out without gaining speed", "[contact]") {
  Random random(8);
  const Collider ball = ball_collider({0.1, 0.2, 0.3}, 0.5, 0.3);
  const Collider ground = floor_collider(0.3);
  for (int trial = 0; trial < 300; ++trial) {
    const Collider& collider = trial % 2 == 0 ? ball : ground;
    ContactStage stage({collider}, {});
    stage.begin_substep(0, 0.01);
    const Vec3 begin =
        trial % 2 == 0
            ? Vec3(Vec3(0.1, 0.2, 0.3) + random.uniform(0, 0.49) * random_direction(random))
            : Vec3(0.3, random.uniform(-0.4, 0), 0);
    Vec3 velocity = 2 * random_direction(random);
    const double speed = velocity.norm();
    Vec3 position = begin + 0.01 * velocity;
    stage.resolve(begin, position, velocity);
    CHECK(height(collider, position, 0.01) >= -kRoundingDepth);
    CHECK(velocity.norm() <= speed * (1 + 1e-15));
  }
}

TEST_CASE("contact: a vertex in the very centre of a sphere gets out", "[contact]") {
  const Collider ball = ball_collider({0, 0, 0}, 0.5, 0.3);
  ContactStage stage({ball}, {});
  stage.begin_substep(0, 0.01);
  Vec3 position = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  CHECK(stage.resolve(Vec3::Zero(), position, velocity));
  CHECK(height(ball, position, 0.01) == Approx(0).margin(kRoundingDepth));
}

TEST_CASE("contact: friction obeys Coulomb's bound and never adds energy", "[contact]") {
  Random random(9);
  for (int trial = 0; trial < 300; ++trial) {
    const double friction = random.uniform(0, 1.5);
    Collider ball = ball_collider({0, 0, 0}, 0.5, friction);
    const Vec3 velocity_of_ball = 3 * random_direction(random);
    ball.motion = steady_motion(velocity_of_ball);
    ContactStage stage({ball}, {});
    stage.begin_substep(0, 0.1);
    const Vec3 side = random_direction(random);
    const Vec3 begin = 0.6 * side;
    const Vec3 velocity_before = velocity_of_ball + 5 * (random_direction(random) - side);
    Vec3 position = begin + 0.1 * velocity_before;
    Vec3 velocity = velocity_before;
    if (!stage.resolve(begin, position, velocity)) continue;
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

TEST_CASE("contact: a fast ball takes resting vertices with it", "[contact]") {
  const double h = GENERATE(1.0 / 30, 1.0 / 240);
  const double speed = 60;  // [m/s]: 2 m in the longer substep, past a vertex 1 m away
  Collider ball = ball_collider({-1, 0, 0}, 0.1, 0);
  ball.motion = steady_motion({speed, 0, 0});
  ContactStage stage({ball}, {});
  Particle ahead{{0, 0, 0}, {0, 0, 0}};
  Particle aside{{0, 0.08, 0}, {0, 0, 0}};
  const int n_steps = static_cast<int>(std::lround(0.1 / h));
  for (int k = 0; k < n_steps; ++k) {
    step(stage, Vec3::Zero(), k * h, h, ahead);
    step(stage, Vec3::Zero(), k * h, h, aside);
    REQUIRE(height(ball, ahead.position, (k + 1) * h) >= -10 * kRoundingDepth);
    REQUIRE(height(ball, aside.position, (k + 1) * h) >= -10 * kRoundingDepth);
  }
  CHECK((ahead.velocity - Vec3(speed, 0, 0)).norm() < 1e-12);
  CHECK(ahead.position.x() == Approx(-1 + 0.1 + speed * 0.1));
  // Hit where the normal is (-0.6, 0.8, 0): it leaves with the ball's normal velocity alone.
  CHECK((aside.velocity - 0.6 * speed * Vec3(0.6, 0.8, 0)).norm() < 1e-9);
}

TEST_CASE("contact: a belt drags by mu g until the vertex rides along", "[contact]") {
  const double h = GENERATE(1.0 / 60, 1.0 / 1000);
  Collider belt = floor_collider(0.4);
  belt.motion = steady_motion({2, 0, 0});
  ContactStage stage({belt}, {});
  Particle particle{{0, 0, 0}, {0, 0, 0}};
  const int n_slip = static_cast<int>(std::lround(0.4 / h));  // it rides after 2 / (0.4 g) = 0.51 s
  for (int k = 0; k < n_slip; ++k) step(stage, -kGravity * kUp, k * h, h, particle);
  CHECK(particle.velocity.x() == Approx(0.4 * kGravity * n_slip * h).epsilon(1e-10));
  const int n_ride = static_cast<int>(std::lround(0.6 / h));
  for (int k = n_slip; k < n_ride; ++k) step(stage, -kGravity * kUp, k * h, h, particle);
  CHECK((particle.velocity - Vec3(2, 0, 0)).norm() < 1e-12);
  const double x = particle.position.x();
  for (int k = n_ride; k < 2 * n_ride; ++k) step(stage, -kGravity * kUp, k * h, h, particle);
  CHECK(particle.position.x() - x == Approx(2 * n_ride * h).epsilon(1e-10));
}

TEST_CASE("contact: a spinning-free ball moving sideways drags what lies on it", "[contact]") {
  Collider ball = ball_collider({0, -0.5, 0}, 0.5, 0.4);
  ball.motion = steady_motion({0.05, 0, 0});
  ContactStage stage({ball}, {});
  Particle particle{{0, 0, 0}, {0, 0, 0}};
  const double h = 1.0 / 1000;
  for (int k = 0; k < 200; ++k) step(stage, -kGravity * kUp, k * h, h, particle);
  CHECK((particle.velocity - Vec3(0.05, 0, 0)).norm() < 1e-4);
}

// Energy and the centripetal force part a frictionless vertex from a sphere where cos = 2/3.
TEST_CASE("contact: a vertex leaves a smooth ball at the angle acos 2/3", "[contact]") {
  const auto leaving_cosine = [](double h) {
    ContactStage stage({ball_collider({0, 0, 0}, 1, 0)}, {});
    Particle particle{{std::sin(0.05), std::cos(0.05), 0}, {0, 0, 0}};
    double cosine = 1;
    for (int k = 0; particle.position.y() > 0; ++k) {
      const Vec3 begin = particle.position;
      if (step(stage, -kGravity * kUp, k * h, h, particle)) cosine = begin.normalized().y();
    }
    return cosine;
  };
  const double exact = 2.0 / 3 * std::cos(0.05);  // from rest at 0.05 rad
  const double error_coarse = std::abs(leaving_cosine(1e-3) - exact);
  const double error_fine = std::abs(leaving_cosine(1e-4) - exact);
  CAPTURE(error_coarse, error_fine);
  // The contact force fades to nothing at the angle, so the last touch is known to about the root
  // of the step.
  CHECK(error_fine < 0.4 * error_coarse);
  CHECK(error_fine < 2e-3);
}

TEST_CASE("contact: the gap between ball and floor is left sideways", "[contact]") {
  const bool ball_first = GENERATE(true, false);
  const double speed = GENERATE(0.0, 5.0, 50.0);
  CAPTURE(ball_first, speed);
  const Collider ball = ball_collider({0, 0.3, 0}, 0.3, 0.3);
  const Collider ground = floor_collider(0.3);
  ContactStage stage(
      ball_first ? std::vector<Collider>{ball, ground} : std::vector<Collider>{ground, ball},
      {0.002, 0.01});
  Random random(10);
  for (int trial = 0; trial < 200; ++trial) {
    Particle particle{{0.5, 0.05, 0}, {0, 0, 0}};
    particle.velocity =
        speed *
        (Vec3(0, 0.02, 0) + 0.1 * random_direction(random) - particle.position).normalized();
    for (int k = 0; k < 20; ++k) {
      const Vec3 begin = particle.position;
      particle.velocity +=
          Vec3(-100, -kGravity, 0) / 60;  // pressed into the gap as springs would press it
      particle.position += particle.velocity / 60;
      const double speed_before = particle.velocity.norm();
      stage.begin_substep(k / 60.0, (k + 1) / 60.0);
      stage.resolve(begin, particle.position, particle.velocity);
      REQUIRE(height(ball, particle.position, 0) >= stage.clearance(ball) - 1e-12);
      REQUIRE(height(ground, particle.position, 0) >= stage.clearance(ground) - 1e-12);
      REQUIRE(particle.velocity.norm() <= speed_before * (1 + 1e-14));
    }
  }
  CHECK(stage.n_unresolved() == 0);
}

TEST_CASE("contact: a corner of three walls holds a vertex", "[contact]") {
  std::vector<Collider> walls(3, floor_collider(0.3));
  walls[0].shape = Plane{Vec3::Zero(), Vec3(1, 0.2, 0).normalized()};
  walls[1].shape = Plane{Vec3::Zero(), Vec3(0, 1, 0.2).normalized()};
  walls[2].shape = Plane{Vec3::Zero(), Vec3(0.2, 0, 1).normalized()};
  ContactStage stage(walls, {});
  Particle particle{{1, 1, 1}, Vec3(-5, -6, -7)};
  for (int k = 0; k < 100; ++k) {
    step(stage, Vec3(-10, -10, -10), k / 60.0, 1 / 60.0, particle);
    for (const Collider& wall : walls) REQUIRE(height(wall, particle.position, 0) >= -1e-12);
  }
  CHECK(particle.position.norm() < 1e-3);
  CHECK(particle.velocity.norm() < 0.05);  // of the 0.29 m/s that each step adds
  CHECK(stage.n_unresolved() == 0);
}

TEST_CASE("contact: a vertex crushed between two walls is counted", "[contact]") {
  Collider ceiling = floor_collider(0.3);
  ceiling.shape = Plane{{0, 1, 0}, {0, -1, 0}};
  ceiling.motion = steady_motion({0, -2, 0});
  ContactStage stage({floor_collider(0.3), ceiling}, {});
  stage.begin_substep(0, 1);
  Vec3 position{0, 0.5, 0};
  Vec3 velocity = Vec3::Zero();
  CHECK(stage.resolve({0, 0.5, 0}, position, velocity));
  CHECK(stage.n_unresolved() == 1);
  CHECK(position.allFinite());
  CHECK(velocity.allFinite());
}

TEST_CASE("contact: neither a far solid nor their order changes a bit", "[contact]") {
  Random random(14);
  const Collider ball = ball_collider({0, 0.3, 0}, 0.3, 0.2);
  const Collider ground = floor_collider(0.4);
  const Collider far = ball_collider({100, 0, 0}, 1, 0);
  ContactStage one({ball, ground}, {});
  ContactStage other({far, ground, ball}, {});
  one.begin_substep(0, 0.1);
  other.begin_substep(0, 0.1);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 begin{random.uniform(-1, 1), random.uniform(0.7, 1), random.uniform(-1, 1)};
    const Vec3 velocity_before = 15 * random_direction(random) - Vec3(0, 10, 0);
    Vec3 position_one = begin + 0.1 * velocity_before;
    Vec3 position_other = position_one;
    Vec3 velocity_one = velocity_before;
    Vec3 velocity_other = velocity_before;
    one.resolve(begin, position_one, velocity_one);
    other.resolve(begin, position_other, velocity_other);
    CHECK((position_one == position_other && velocity_one == velocity_other));
  }
}

TEST_CASE("contact: a mirrored vertex has the mirrored answer, to the bit", "[contact]") {
  Random random(15);
  const Vec3 mirror(-1, 1, 1);
  ContactStage stage({floor_collider(0.4), ball_collider({0, 0.3, 0.1}, 0.3, 0.2)}, {0.001, 0.01});
  stage.begin_substep(0, 0.1);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 begin{random.uniform(-1, 1), random.uniform(0.7, 1), random.uniform(-1, 1)};
    Vec3 velocity = 15 * random_direction(random) - Vec3(0, 10, 0);
    Vec3 position = begin + 0.1 * velocity;
    Vec3 mirrored_position = position.cwiseProduct(mirror);
    Vec3 mirrored_velocity = velocity.cwiseProduct(mirror);
    stage.resolve(begin, position, velocity);
    stage.resolve(begin.cwiseProduct(mirror), mirrored_position, mirrored_velocity);
    CHECK(mirrored_position == position.cwiseProduct(mirror));
    CHECK(mirrored_velocity == velocity.cwiseProduct(mirror));
  }
}

TEST_CASE("contact: only the motion relative to the solid counts", "[contact]") {
  Random random(16);
  const Vec3 drift(7, -3, 2);  // [m/s]
  Collider ball = ball_collider({0, 0, 0}, 0.5, 0.3);
  ContactStage at_rest({ball}, {});
  ball.motion = steady_motion(drift);
  ContactStage moving({ball}, {});
  at_rest.begin_substep(0, 0.1);
  moving.begin_substep(0, 0.1);
  for (int trial = 0; trial < 100; ++trial) {
    const Vec3 begin = 0.8 * random_direction(random);
    Vec3 velocity = -8 * begin + 3 * random_direction(random);
    Vec3 position = begin + 0.1 * velocity;
    Vec3 moving_velocity = velocity + drift;
    Vec3 moving_position = position + 0.1 * drift;
    REQUIRE(at_rest.resolve(begin, position, velocity) ==
            moving.resolve(begin, moving_position, moving_velocity));
    CHECK((moving_velocity - drift - velocity).norm() < 1e-13);
    CHECK((moving_position - 0.1 * drift - position).norm() < 1e-13);
  }
}

// A flat face whose corners lie anywhere at or above the clearance; its points by barycentric
// samples.
TEST_CASE("contact: a face held by its corners does not cut the sphere", "[contact]") {
  Random random(17);
  const double radius = GENERATE(0.03, 0.3);
  const Collider ball = ball_collider({0, 0, 0}, radius, 0);
  const double circumradius = 0.02;
  const double half_thickness = 0.0005;
  ContactStage stage({ball}, {half_thickness, circumradius});
  CHECK(stage.clearance(ball) ==
        Approx(half_thickness + std::sqrt(radius * radius + circumradius * circumradius) - radius));
  CHECK(stage.clearance(floor_collider(0)) == half_thickness);
  const double held = radius + stage.clearance(ball);
  for (int trial = 0; trial < 500; ++trial) {
    // Three points of a circle of that radius, whose plane is tilted until all of them are clear.
    const Vec3 normal = random_direction(random);
    const Vec3 across = normal.cross(random_direction(random)).normalized();
    const Vec3 along = normal.cross(across);
    std::array<Vec3, 3> corners;
    for (Vec3& corner : corners) {
      const double angle = random.uniform(0, 6.283185307179586);
      corner = circumradius * (std::cos(angle) * across + std::sin(angle) * along);
    }
    const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3;
    const Vec3 tilt = random.uniform(0, 0.3) * along + normal;
    double lift = 0;
    while (std::any_of(corners.begin(), corners.end(), [&](const Vec3& corner) {
      return (corner - middle + lift * tilt).norm() < held;
    })) {
      lift += 1e-5;
    }
    for (int sample = 0; sample < 50; ++sample) {
      double a = random.uniform(0, 1);
      double b = random.uniform(0, 1);
      if (a + b > 1) {
        a = 1 - a;
        b = 1 - b;
      }
      const Vec3 point =
          a * corners[0] + b * corners[1] + (1 - a - b) * corners[2] - middle + lift * tilt;
      REQUIRE(point.norm() >= radius + half_thickness - 1e-15);
    }
  }
}

TEST_CASE("contact: a vertex that is not finite is left for the stepper to report", "[contact]") {
  const double bad =
      GENERATE(std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity());
  ContactStage stage({floor_collider(0.3), ball_collider({0, 0, 0}, 1, 0.3)}, {});
  stage.begin_substep(0, 0.1);
  const int broken = GENERATE(0, 1, 2);
  CAPTURE(bad, broken);
  Vec3 begin{0, 2, 0};
  Vec3 position{0, -0.5, 0};
  Vec3 velocity{0, -25, 0};
  (broken == 0 ? begin : broken == 1 ? position : velocity).y() = bad;
  const Vec3 position_before = position;
  CHECK_FALSE(stage.resolve(begin, position, velocity));
  CHECK(position.x() == 0);
  CHECK((position.y() == position_before.y() || std::isnan(bad)));
}

TEST_CASE("contact: colliders and sizes that make no sense are our bug", "[contact]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto make = [](const Collider& collider) { return ContactStage({collider}, {}); };
  CHECK_THROWS_AS(make(ball_collider({0, 0, 0}, 0, 0.3)), ContractError);
  CHECK_THROWS_AS(make(ball_collider({0, 0, 0}, nan, 0.3)), ContractError);
  CHECK_THROWS_AS(make(ball_collider({0, nan, 0}, 1, 0.3)), ContractError);
  CHECK_THROWS_AS(make(floor_collider(-0.1)), ContractError);
  CHECK_THROWS_AS(make(floor_collider(nan)), ContractError);
  Collider slanted = floor_collider(0);
  slanted.shape = Plane{Vec3::Zero(), {0, 1.01, 0}};
  CHECK_THROWS_AS(make(slanted), ContractError);
  CHECK_THROWS_AS(ContactStage({}, {-1, 0}), ContractError);
  CHECK_THROWS_AS(ContactStage({}, {0, nan}), ContractError);
  ContactStage stage({floor_collider(0)}, {});
  CHECK_THROWS_AS(stage.begin_substep(1, 1), ContractError);
}

TEST_CASE("contact: a substep allocates nothing", "[contact]") {
  if (!kCountsAllocations) {
    SUCCEED("not counted: the sanitizer has a malloc of its own");
    return;
  }
  ContactStage stage({floor_collider(0.3), ball_collider({0, 0.3, 0}, 0.3, 0.3)}, {0.001, 0.01});
  CHECK(allocations_in([&] {
          Particle particle{{0.5, 0.05, 0}, {-20, 0, 0}};
          for (int k = 0; k < 50; ++k)
            step(stage, Vec3(-100, -kGravity, 0), k / 60.0, 1 / 60.0, particle);
        }) == 0);
}

}  // namespace pleat
