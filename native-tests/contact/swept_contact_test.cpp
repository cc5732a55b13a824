#include "core/contact/swept_contact.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "native-tests/support/particle.h"

namespace pleat {
namespace {}  // namespace

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
    ContactPass pass({wall}, {0.001, {}});
    Particle particle{std::get<Plane>(wall.shape).point + random.uniform(0.002, 0.5) * normal,
                      50 * random_direction(random)};
    for (int k = 0; k < 8; ++k) {
      step(pass, -kGravity * kUp, k * h, h, particle);
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
    ContactPass pass({ball}, {});
    const Vec3 centre = std::get<Sphere>(ball.shape).centre;
    Particle particle{centre + random.uniform(1.01, 3) * radius * random_direction(random),
                      Vec3::Zero()};
    // Aimed past the centre by up to its radius and a little more: full, side, grazing and missed
    // hits.
    const Vec3 aim = centre + random.uniform(0, 1.1) * radius * random_direction(random);
    particle.velocity = 50 * (aim - particle.position).normalized();
    for (int k = 0; k < 4; ++k) {
      const Vec3 begin = particle.position;
      n_hits += step(pass, -kGravity * kUp, k * h, h, particle);
      REQUIRE(height(ball, particle.position, (k + 1) * h) >= -10 * kRoundingDepth);
      // Nor has the way there led through: seen from the sphere it is straight before and after the
      // correction.
      const Vec3 start = begin - ball.motion.pose(k * h).translation - centre;
      const Vec3 way =
          particle.position - ball.motion.pose((k + 1) * h).translation - centre - start;
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

TEST_CASE("contact: a vertex that begins inside is put out without gaining speed", "[contact]") {
  Random random(8);
  const Collider ball = ball_collider({0.1, 0.2, 0.3}, 0.5, 0.3);
  const Collider ground = floor_collider(0.3);
  for (int trial = 0; trial < 300; ++trial) {
    const Collider& collider = trial % 2 == 0 ? ball : ground;
    ContactPass pass({collider}, {});
    pass.begin_substep(0, 0.01);
    const Vec3 begin =
        trial % 2 == 0
            ? Vec3(Vec3(0.1, 0.2, 0.3) + random.uniform(0, 0.49) * random_direction(random))
            : Vec3(0.3, random.uniform(-0.4, 0), 0);
    Vec3 velocity = 2 * random_direction(random);
    const double speed = velocity.norm();
    Vec3 position = begin + 0.01 * velocity;
    resolve(pass, VertexId(0), begin, position, velocity);
    CHECK(height(collider, position, 0.01) >= -kRoundingDepth);
    CHECK(velocity.norm() <= speed * (1 + 1e-15));
  }
}

TEST_CASE("contact: a vertex in the very centre of a sphere gets out", "[contact]") {
  const Collider ball = ball_collider({0, 0, 0}, 0.5, 0.3);
  ContactPass pass({ball}, {});
  pass.begin_substep(0, 0.01);
  Vec3 position = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  CHECK(resolve(pass, VertexId(0), Vec3::Zero(), position, velocity));
  CHECK(height(ball, position, 0.01) == Approx(0).margin(kRoundingDepth));
}

TEST_CASE("contact: a fast ball takes resting vertices with it", "[contact]") {
  const double h = GENERATE(1.0 / 30, 1.0 / 240);
  const double speed = 60;  // [m/s]: 2 m in the longer substep, past a vertex 1 m away
  Collider ball = ball_collider({-1, 0, 0}, 0.1, 0);
  ball.motion = steady_motion({speed, 0, 0});
  ContactPass pass({ball}, {});
  Particle ahead{{0, 0, 0}, {0, 0, 0}};
  Particle aside{{0, 0.08, 0}, {0, 0, 0}};
  const int n_steps = static_cast<int>(std::lround(0.1 / h));
  for (int k = 0; k < n_steps; ++k) {
    step(pass, Vec3::Zero(), k * h, h, ahead);
    step(pass, Vec3::Zero(), k * h, h, aside);
    REQUIRE(height(ball, ahead.position, (k + 1) * h) >= -10 * kRoundingDepth);
    REQUIRE(height(ball, aside.position, (k + 1) * h) >= -10 * kRoundingDepth);
  }
  CHECK((ahead.velocity - Vec3(speed, 0, 0)).norm() < 1e-12);
  CHECK(ahead.position.x() == Approx(-1 + 0.1 + speed * 0.1));
  // Hit where the normal is (-0.6, 0.8, 0): it leaves with the ball's normal velocity alone.
  CHECK((aside.velocity - 0.6 * speed * Vec3(0.6, 0.8, 0)).norm() < 1e-9);
}

TEST_CASE("contact: the solid that is met first acts first", "[contact]") {
  const Collider ball = ball_collider({0, 0.3, 0}, 0.3, 0);
  ContactPass ball_alone({ball}, {});
  ContactPass floor_and_ball({floor_collider(0), ball}, {});
  const Vec3 begin(0.1, 1, 0);
  const Vec3 down(0, -14, 0);
  const auto result = [&](ContactPass& pass) {
    Particle particle{begin + 0.1 * down, down};
    pass.begin_substep(0, 0.1);
    CHECK(resolve(pass, VertexId(0), begin, particle.position, particle.velocity));
    return particle;
  };
  // Thrown off the ball's side before it could reach the floor.
  CHECK(result(floor_and_ball).position == result(ball_alone).position);
  CHECK(result(floor_and_ball).velocity == result(ball_alone).velocity);
}

TEST_CASE("contact: the gap between ball and floor is left sideways", "[contact]") {
  const bool ball_first = GENERATE(true, false);
  const double speed = GENERATE(0.0, 5.0, 50.0);
  CAPTURE(ball_first, speed);
  const Collider ball = ball_collider({0, 0.3, 0}, 0.3, 0.3);
  const Collider ground = floor_collider(0.3);
  ContactPass pass(
      ball_first ? std::vector<Collider>{ball, ground} : std::vector<Collider>{ground, ball},
      {0.002, Eigen::VectorXd::Constant(1, 0.01)});
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
      pass.begin_substep(k / 60.0, (k + 1) / 60.0);
      resolve(pass, VertexId(0), begin, particle.position, particle.velocity);
      REQUIRE(height(ball, particle.position, 0) >= pass.clearance(ball, VertexId(0)).at_a - 1e-12);
      REQUIRE(height(ground, particle.position, 0) >=
              pass.clearance(ground, VertexId(0)).at_a - 1e-12);
      REQUIRE(particle.velocity.norm() <= speed_before * (1 + 1e-14));
    }
  }
  CHECK(pass.n_unresolved() == 0);
}

TEST_CASE("contact: a groove leaves only the motion along it", "[contact]") {
  // Slope of both walls [rad]; steep: neither throws out of the other.
  const double slope = GENERATE(0.8, 1.1, 1.4);
  const double sideways = GENERATE(-1.0, 0.0, 0.3);
  CAPTURE(slope, sideways);
  std::vector<Collider> walls(2, floor_collider(0));
  walls[0].shape = Plane{Vec3::Zero(), Vec3(std::sin(slope), std::cos(slope), 0)};
  walls[1].shape = Plane{Vec3::Zero(), Vec3(-std::sin(slope), std::cos(slope), 0)};
  ContactPass pass(walls, {});
  pass.begin_substep(0, 0.1);
  Vec3 velocity(sideways, -20, 3);
  const Vec3 begin(0.01, 0.5, 0);
  Vec3 position = begin + 0.1 * velocity;
  CHECK(resolve(pass, VertexId(0), begin, position, velocity));
  CHECK((velocity - Vec3(0, 0, 3)).norm() < 1e-13);
  CHECK((position - Vec3(0, 0, 0.3)).norm() < 1e-13);
}

TEST_CASE("contact: a corner of three walls holds a vertex", "[contact]") {
  std::vector<Collider> walls(3, floor_collider(0.3));
  walls[0].shape = Plane{Vec3::Zero(), Vec3(1, 0.2, 0).normalized()};
  walls[1].shape = Plane{Vec3::Zero(), Vec3(0, 1, 0.2).normalized()};
  walls[2].shape = Plane{Vec3::Zero(), Vec3(0.2, 0, 1).normalized()};
  ContactPass pass(walls, {});
  Particle particle{{1, 1, 1}, Vec3(-5, -6, -7)};
  for (int k = 0; k < 100; ++k) {
    step(pass, Vec3(-10, -10, -10), k / 60.0, 1 / 60.0, particle);
    for (const Collider& wall : walls) REQUIRE(height(wall, particle.position, 0) >= -1e-12);
  }
  CHECK(particle.position.norm() < 1e-3);
  CHECK(particle.velocity.norm() < 0.05);  // each step adds 0.29 m/s
  CHECK(pass.n_unresolved() == 0);
}

TEST_CASE("contact: far from the origin, rounding does not count as a contact", "[contact]") {
  Random random(18);
  std::int64_t n_unresolved = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const Vec3 place = (trial % 2 == 0 ? 1 : 1e4) * random_direction(random);
    const Vec3 normal_a = random_direction(random);
    const Vec3 normal_b = random_direction(random);
    if (normal_a.cross(normal_b).norm() < 0.05) continue;
    std::vector<Collider> solids(2, floor_collider(0.3));
    solids[0].shape = Plane{place, normal_a};
    solids[1] = ball_collider(place - 0.3 * normal_b, 0.3, 0.3);
    ContactPass pass(solids, {});
    Particle particle{place + 0.5 * (normal_a + normal_b), {0, 0, 0}};
    for (int k = 0; k < 30; ++k) {
      step(pass, -20 * (normal_a + normal_b), k / 60.0, 1 / 60.0, particle);
    }
    n_unresolved += pass.n_unresolved();
  }
  CHECK(n_unresolved == 0);
}

// The jaws leave half of the thickness, and move along with what they hold.
TEST_CASE("contact: rough jaws carry what they close on, and a smooth one lets it slide",
          "[contact]") {
  constexpr double kHalfThickness = 5e-4;
  const double friction = GENERATE(0.0, 0.3);
  CAPTURE(friction);
  const Vec3 drive(0.2, 0, 0.1);
  std::vector<Collider> jaws{floor_collider(0.3), floor_collider(friction)};
  for (const int k : {0, 1}) {
    const double side = 1 - 2 * k;
    jaws[static_cast<std::size_t>(k)].shape =
        Plane{{0, -side * kHalfThickness / 2, 0}, {0, side, 0}};
    jaws[static_cast<std::size_t>(k)].motion = steady_motion(drive);
  }
  ContactPass pass(jaws, {kHalfThickness, {}});
  Particle particle{Vec3(0, 1e-5, 0), drive};
  constexpr int kSteps = 30;
  for (int k = 0; k < kSteps; ++k) step(pass, Vec3(0, 0, -9.81), k / 60.0, 1 / 60.0, particle);
  const Vec3 carried = kSteps / 60.0 * drive;
  const double slip = (particle.position - carried).norm();
  if (friction > 0)
    CHECK(slip < 2e-5);
  else
    CHECK(slip > 0.1);
}

// Two balls with room for the cloth, whose clearances for coarse faces overlap.
TEST_CASE("contact: what coarse faces ask of two balls leaves the gap between them open",
          "[contact]") {
  constexpr double kRadius = 0.1;
  constexpr double kHalfThickness = 5e-4;
  constexpr double kGap = 8e-3;
  std::vector<Collider> balls;
  for (const double side : {-1.0, 1.0})
    balls.push_back(ball_collider({side * (kRadius + kGap / 2), 0, 0}, kRadius, 0));
  const bool is_closed = GENERATE(false, true);  // overlapping balls are one body
  if (is_closed) balls[1] = ball_collider({kRadius - kGap, 0, 0}, kRadius, 0);
  ContactPass pass(balls, {kHalfThickness, Eigen::VectorXd::Constant(1, 0.05)});
  const double alone = pass.clearance(balls[0], VertexId(0)).at_a;
  REQUIRE(alone > kGap);
  pass.begin_substep(0, 1);
  Vec3 position(0, -0.2, 0);
  Vec3 velocity(0, -0.4, 0);
  const auto touch = pass.resolve(VertexId(0), {0, 0.2, 0}, position, velocity);
  CHECK(touch.has_value() == is_closed);
  if (!is_closed) CHECK(position == Vec3(0, -0.2, 0));
}

TEST_CASE("contact: a vertex crushed between two walls is counted", "[contact]") {
  Collider ceiling = floor_collider(0.3);
  ceiling.shape = Plane{{0, 1, 0}, {0, -1, 0}};
  ceiling.motion = steady_motion({0, -2, 0});
  ContactPass pass({floor_collider(0.3), ceiling}, {});
  pass.begin_substep(0, 1);
  Vec3 position{0, 0.5, 0};
  Vec3 velocity = Vec3::Zero();
  CHECK(resolve(pass, VertexId(0), {0, 0.5, 0}, position, velocity));
  CHECK(pass.n_unresolved() == 1);
  CHECK(position.allFinite());
  CHECK(velocity.allFinite());
}

// A flat face whose corners lie anywhere at or above the clearance; its points by barycentric
// samples.
TEST_CASE("contact: a face held by its corners does not cut the sphere", "[contact]") {
  Random random(17);
  const double radius = GENERATE(0.03, 0.3);
  const Collider ball = ball_collider({0, 0, 0}, radius, 0);
  const double circumradius = 0.02;
  const double half_thickness = 0.0005;
  ContactPass pass({ball}, {half_thickness, Eigen::VectorXd::Constant(1, circumradius)});
  CHECK(pass.clearance(ball, VertexId(0)).at_a ==
        Approx(half_thickness + std::sqrt(radius * radius + circumradius * circumradius) - radius));
  CHECK(pass.clearance(floor_collider(0), VertexId(0)).at_a == half_thickness);
  const double held = radius + pass.clearance(ball, VertexId(0)).at_a;
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

}  // namespace pleat
