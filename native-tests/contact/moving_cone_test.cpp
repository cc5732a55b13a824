#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/check.h"
#include "native-tests/support/allocation_count.h"
#include "native-tests/support/particle.h"

namespace pleat {
namespace {

const VertexId kVertex{0};

/// A limb along y, its thin end up.
RoundedCone limb() { return {{0, -0.3, 0}, {0, 0.3, 0}, 0.1, 0.06}; }

/// A board with its level upper side at y = 0.
RoundedCone board() {
  RoundedCone board{{-1, -0.1, 0}, {1, -0.1, 0}, 0.1, 0.1};
  board.half_width_a = board.half_width_b = 1;
  return board;
}

/// A limb whose topmost line falls by `slope` [rad] along +x through the origin.
RoundedCone incline(double slope) {
  const Vec3 downhill(std::cos(slope), -std::sin(slope), 0);
  const Vec3 normal(std::sin(slope), std::cos(slope), 0);
  // The line touches both end balls, so their centres are their radii below it.
  RoundedCone cone;
  cone.radius_a = 0.3;
  cone.radius_b = 0.1;
  cone.centre_a = -40 * downhill - cone.radius_a * normal;
  cone.centre_b = 40 * downhill - cone.radius_b * normal;
  return cone;
}

}  // namespace

TEST_CASE("contact: a limb is never penetrated at 50 m/s, however it turns", "[contact]") {
  const double h = GENERATE(1.0 / 30, 1.0 / 240);
  const double spin = GENERATE(0.0, 10.0, 30.0);
  CAPTURE(h, spin);
  Random random(40);
  int n_hits = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Collider collider = cone_collider(limb(), random.uniform(0, 1));
    if (trial % 3 == 0) std::get<RoundedCone>(collider.shape).half_width_b = 0.1;
    const Vec3 velocity = 10 * random_direction(random);
    collider.motion = spin > 0 ? turning_motion(spin * random_direction(random), velocity)
                               : steady_motion(velocity);
    ContactPass pass({collider}, {0.001, {}});
    // Aimed at the side, at the ends, and past them.
    const Vec3 aim = random.uniform(-0.4, 0.4) * kUp + 0.1 * random_direction(random);
    Particle particle{0.6 * random_direction(random), Vec3::Zero()};
    particle.velocity = 50 * (aim - particle.position).normalized();
    for (int k = 0; k < 4; ++k) {
      const Vec3 begin = particle.position;
      n_hits += step(pass, -kGravity * kUp, k * h, h, particle);
      REQUIRE(height(collider, particle.position, (k + 1) * h) >= 0.001 - 1e-13);
      // Nor has the way there led through, straight in the limb's own frame.
      const Vec3 start = collider.motion.pose(k * h).inverse() * begin;
      const Vec3 end = collider.motion.pose((k + 1) * h).inverse() * particle.position;
      for (int sample = 0; sample <= 100; ++sample)
        REQUIRE(height(collider, start + 0.01 * sample * (end - start), 0) >= 0.001 - 1e-12);
    }
  }
  CHECK(n_hits > 40);
}

TEST_CASE("contact: a vertex inside of a limb is put out without gaining speed", "[contact]") {
  Random random(41);
  for (int trial = 0; trial < 500; ++trial) {
    const RoundedCone cone = random_cone(random);
    const Collider collider = cone_collider(cone, 0.3);
    ContactPass pass({collider}, {});
    pass.begin_substep(0, 0.01);
    const double share = random.uniform(0, 1);
    const Vec3 begin =
        cone.centre_a + share * (cone.centre_b - cone.centre_a) + 0.01 * random_direction(random);
    Vec3 velocity = random_direction(random);
    Vec3 position = begin + 0.01 * velocity;
    CHECK(resolve(pass, kVertex, begin, position, velocity));
    CHECK(height(collider, position, 0) >= -1e-13);
    CHECK(velocity.norm() <= 1 + 1e-14);
  }
}

TEST_CASE("contact: on a limb that lies still a vertex comes to rest and stays", "[contact]") {
  const double h = GENERATE(1.0 / 60, 1.0 / 1000);
  Collider collider = cone_collider(incline(0.2), 0.3);
  ContactPass pass({collider}, {0.001, {}});
  Particle particle{{0, 0.1, 0}, {0, 0, 0}};
  Vec3 settled = Vec3::Zero();
  for (int k = 0; k < 2000; ++k) {
    step(pass, -kGravity * kUp, k * h, h, particle);
    if (k == 1000) settled = particle.position;
    if (k >= 1000) {
      REQUIRE(particle.velocity == Vec3(0, 0, 0));
      REQUIRE((particle.position - settled).norm() < 1e-13);
    }
  }
  CHECK(height(collider, particle.position, 0) == Approx(0.001).epsilon(1e-11));
}

TEST_CASE("contact: on a moving incline of a limb friction keeps to Coulomb's cone", "[contact]") {
  const double h = GENERATE(1.0 / 60, 1.0 / 1000);
  const double slope = GENERATE(0.25, 0.5);  // [rad]; atan 0.3 = 0.2915
  CAPTURE(h, slope);
  const Vec3 velocity{1, 0.5, -0.3};
  Collider collider = cone_collider(incline(slope), 0.3);
  collider.motion = steady_motion(velocity);
  ContactPass pass({collider}, {});
  Particle block{Vec3::Zero(), velocity};
  const int n_steps = static_cast<int>(std::lround(2 / h));
  for (int k = 0; k < n_steps; ++k) step(pass, -kGravity * kUp, k * h, h, block);
  const double acceleration = std::max(0.0, kGravity * (std::sin(slope) - 0.3 * std::cos(slope)));
  const Vec3 downhill(std::cos(slope), -std::sin(slope), 0);
  CHECK((block.velocity - velocity - 2 * acceleration * downhill).norm() < 1e-9);
  CHECK((block.position - 2 * velocity - acceleration * (2 + h) * downhill).norm() < 1e-9);
}

// A vertex at the radius r rides on a turntable while w^2 r < mu g; its velocity is that of the
// chord that its point of the board goes, and changes by the chord's turn.
TEST_CASE("contact: a vertex that sticks to a turning board rides along", "[contact]") {
  const double h = GENERATE(1.0 / 60, 1.0 / 1000);
  const double spin = 3;
  const double chord_spin = 2 * std::sin(spin * h / 2) / h;
  const double limit = 0.4 * kGravity / (chord_spin * chord_spin);
  CAPTURE(h);
  for (const double share : {0.3, 0.99, 1.05}) {
    Collider collider = cone_collider(board(), 0.4);
    collider.motion = turning_motion(spin * kUp, Vec3::Zero());
    ContactPass pass({collider}, {});
    const Vec3 start{0.6 * share * limit, 0, 0.8 * share * limit};
    Particle particle{start, (start - collider.motion.pose(h).inverse() * start) / h};
    const int n_steps = static_cast<int>(std::lround(1 / h));
    for (int k = 0; k < n_steps; ++k) step(pass, -kGravity * kUp, k * h, h, particle);
    const double off = (particle.position - collider.motion.pose(n_steps * h) * start).norm();
    CAPTURE(share, off);
    CHECK((share < 1 ? off < 1e-12 : off > 1e-4));
    if (share < 1) CHECK(particle.velocity.norm() == Approx(chord_spin * start.norm()));
  }
}

TEST_CASE("contact: a smooth board that turns leaves the way along it", "[contact]") {
  const double fall = GENERATE(0.0, 0.05);  // [m], of the 0.1 m that the vertex comes down
  Collider collider = cone_collider(board(), 0);
  collider.motion = turning_motion(10 * kUp, Vec3::Zero());
  ContactPass pass({collider}, {});
  pass.begin_substep(0, 0.1);
  Vec3 velocity{0.5, -1, 0.3};
  Vec3 position = Vec3(0.2, fall, 0.1) + 0.1 * velocity;
  CHECK(resolve(pass, kVertex, {0.2, fall, 0.1}, position, velocity));
  CHECK((position - Vec3(0.25, 0, 0.13)).norm() < 1e-14);
  CHECK((velocity - Vec3(0.5, 0, 0.3)).norm() < 1e-13);
}

TEST_CASE("contact: a spinning ball drags what touches it along its side", "[contact]") {
  Collider ball = ball_collider({0, 0, 0}, 0.5, 0.4);
  ball.motion = turning_motion({0, 0, 10}, Vec3::Zero());
  ContactPass pass({ball}, {});
  const double h = 1e-4;
  pass.begin_substep(0, h);
  Vec3 velocity{0, -1, 0};
  Vec3 position = 0.5 * kUp + h * velocity;
  CHECK(resolve(pass, kVertex, 0.5 * kUp, position, velocity));
  // The top goes to -x; Coulomb's bound lets 0.4 of the normal change follow.
  CHECK(velocity.x() == Approx(-0.4).epsilon(0.01));
  CHECK(std::abs(velocity.z()) < 1e-15);
  CHECK(height(ball, position, h) >= -kRoundingDepth);
}

TEST_CASE("contact: a floor that tips lifts what lies on it", "[contact]") {
  Collider ground = floor_collider(1e9);
  ground.motion = turning_motion({0, 0, 2}, Vec3::Zero());
  ContactPass pass({ground}, {});
  Particle particle{{0.5, 0, 0}, {0, 0, 0}};
  const double h = 1.0 / 240;
  for (int k = 0; k < 60; ++k) step(pass, -kGravity * kUp, k * h, h, particle);
  CHECK((particle.position - 0.5 * Vec3(std::cos(0.5), std::sin(0.5), 0)).norm() < 1e-12);
}

TEST_CASE("contact: of two limbs that close in, the last to act keeps the vertex out",
          "[contact]") {
  const double aside = GENERATE(0.0, 1e-9, 1e-4, 0.02);  // shift of the middle between axes [m]
  CAPTURE(aside);
  const RoundedCone limb_a{{0, -0.3, 0}, {0, 0.3, 0}, 0.08, 0.08};
  const RoundedCone limb_b{{0.5, -0.3, 0}, {0.5, 0.3, 0}, 0.08, 0.08};
  std::vector<Collider> limbs{cone_collider(limb_a, 0.3), cone_collider(limb_b, 0.3)};
  limbs[0].motion = steady_motion({1, 0, 0});
  limbs[1].motion = steady_motion({-1, 0, 0});
  ContactPass pass(limbs, {});
  Particle particle{{0.25, 0, aside}, {0, 0, 0}};
  const double h = 1.0 / 60;
  for (int k = 0; k < 15; ++k) {
    step(pass, Vec3::Zero(), k * h, h, particle);
    const double time = (k + 1) * h;
    const double height_a = height(limbs[0], particle.position, time);
    const double height_b = height(limbs[1], particle.position, time);
    REQUIRE(std::max(height_a, height_b) >= -1e-13);
    // They leave room for it until their surfaces meet, 0.17 m into their ways.
    if (time < 0.17) REQUIRE(std::min(height_a, height_b) >= -1e-13);
    REQUIRE(particle.velocity.norm() < 2 / 0.04);
    REQUIRE((particle.position - Vec3(0.25, 0, 0)).norm() < 1);
  }
  CHECK((pass.n_unresolved() > 0) == (aside < 0.01));
}

TEST_CASE("contact: between limbs nearer than both clearances a vertex is outside of both",
          "[contact]") {
  const double aside = GENERATE(0.0, 1e-9);       // shift of the middle between axes [m]
  const double gap_end = GENERATE(0.004, 0.009);  // less than one clearance [m]
  CAPTURE(aside, gap_end);
  const double way = (0.5 - 2 * 0.08 - gap_end) / 2;
  const RoundedCone limb_a{{0, -0.3, 0}, {0, 0.3, 0}, 0.08, 0.08};
  const RoundedCone limb_b{{0.5, -0.3, 0}, {0.5, 0.3, 0}, 0.08, 0.08};
  std::vector<Collider> limbs{cone_collider(limb_a, 0.3), cone_collider(limb_b, 0.3)};
  limbs[0].motion = steady_motion({way, 0, 0});
  limbs[1].motion = steady_motion({-way, 0, 0});
  ContactPass pass(limbs, {0.01, {}});
  Particle particle{{0.25, 0, aside}, {0, 0, 0}};
  const double h = 1.0 / 60;
  for (int k = 0; k < 60; ++k) {
    step(pass, Vec3::Zero(), k * h, h, particle);
    REQUIRE(height(limbs[0], particle.position, (k + 1) * h) >= 0);
    REQUIRE(height(limbs[1], particle.position, (k + 1) * h) >= 0);
  }
  CHECK(pass.n_unresolved() > 0);
}

TEST_CASE("contact: every vertex keeps the clearance of its own faces", "[contact]") {
  const Collider collider = GENERATE(ball_collider({0, 0, 0}, 0.1, 0), cone_collider(limb(), 0));
  const Eigen::Vector3d face_radii(0.01, 0.03, 0);
  ContactPass graded({collider}, {0.001, face_radii});
  graded.begin_substep(0, 1);
  for (const VertexId v : {VertexId(0), VertexId(1), VertexId(2)}) {
    Vec3 position{0, 0, 0.05};
    Vec3 velocity{0, 0, -1};
    CHECK(resolve(graded, v, {0, 0, 1.05}, position, velocity));
    const auto sagitta = [&](double radius) { return std::hypot(radius, face_radii[v]) - radius; };
    const auto radii = end_radii(collider.shape);
    const Clearance clearance = graded.clearance(collider, v);
    CAPTURE(v.value);
    CHECK(clearance.at_a == Approx(0.001 + sagitta(radii[0])).epsilon(1e-11));
    CHECK(clearance.at_b == Approx(0.001 + sagitta(radii[1])).epsilon(1e-11));
    CHECK(gap(swept(collider.shape, clearance, Vec3::Zero()), position).distance ==
          Approx(0).margin(1e-12));
  }
}

TEST_CASE("contact: what the faces of other vertices need changes nothing", "[contact]") {
  Random random(43);
  RoundedCone upright = limb();
  upright.centre_a.x() = upright.centre_b.x() = 0.3;
  const std::vector<Collider> solids{cone_collider(limb(), 0.3), cone_collider(upright, 0.2),
                                     ball_collider({0.15, -0.3, 0}, 0.15, 0.3),
                                     floor_collider(0.3)};
  ContactPass alone(solids, {0.001, Eigen::VectorXd::Constant(1, 0.01)});
  ContactPass among_others(solids, {0.001, Eigen::Vector3d(0.01, 0.05, 0)});
  alone.begin_substep(0, 0.1);
  among_others.begin_substep(0, 0.1);
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3 begin = Vec3(0.15, 0.2, 0) + random.uniform(0.2, 0.6) * random_direction(random);
    Vec3 velocity = 10 * (Vec3(0.15, 0.05, 0) + 0.1 * random_direction(random) - begin);
    Vec3 position = begin + 0.1 * velocity;
    Vec3 expected_velocity = velocity;
    Vec3 expected_position = position;
    resolve(alone, kVertex, begin, expected_position, expected_velocity);
    resolve(among_others, kVertex, begin, position, velocity);
    CAPTURE(trial);
    CHECK((position - expected_position).norm() < 1e-10);
    CHECK((velocity - expected_velocity).norm() < 1e-8);
  }
}

TEST_CASE("contact: a face held by its corners does not cut a rounded cone", "[contact]") {
  Random random(42);
  const double circumradius = 0.04;
  for (int trial = 0; trial < 300; ++trial) {
    const Collider collider = cone_collider(random_cone(random), 0);
    ContactPass pass({collider}, {0.0005, Eigen::VectorXd::Constant(1, circumradius)});
    const SweptCone held_off =
        std::get<SweptCone>(swept(collider.shape, pass.clearance(collider, kVertex), Vec3::Zero()));
    const Vec3 normal = random_direction(random);
    const Vec3 across = normal.unitOrthogonal();
    const Vec3 along = normal.cross(across);
    std::array<Vec3, 3> corners;
    for (Vec3& corner : corners) {
      const double angle = random.uniform(0, 6.283185307179586);
      corner = 2 * normal + circumradius * (std::cos(angle) * across + std::sin(angle) * along);
    }
    // Lowered until the first corner is where contact holds it.
    const auto lowest = [&](double way) {
      double least = std::numeric_limits<double>::infinity();
      for (const Vec3& corner : corners)
        least = std::min(least, gap(held_off, corner - way * normal).distance);
      return least;
    };
    double way = 0;
    for (int k = 0; k < 200 && lowest(way) > 1e-9; ++k) way += lowest(way);
    for (int sample = 0; sample < 50; ++sample) {
      const double a = random.uniform(0, 1);
      const double b = random.uniform(0, 1 - a);
      const Vec3 point = a * corners[0] + b * corners[1] + (1 - a - b) * corners[2];
      REQUIRE(height(collider, point - way * normal, 0) >= 0.0005 - 1e-12);
    }
  }
}

// Half of its edge across is all that such a quad asks for, however long it is.
TEST_CASE("contact: a quad with threads along a limb and around it does not cut it", "[contact]") {
  Random random(44);
  for (int trial = 0; trial < 300; ++trial) {
    const double radius = random.uniform(0.03, 0.2);
    const Collider collider = cone_collider({{0, -1, 0}, {0, 1, 0}, radius, radius}, 0);
    const double half_width = random.uniform(0.005, 0.05);
    const ContactPass pass({collider}, {0.0005, Eigen::VectorXd::Constant(1, half_width)});
    const double held = radius + pass.clearance(collider, kVertex).at_a;
    const double distance = std::sqrt(held * held - half_width * half_width);
    double least = std::numeric_limits<double>::infinity();
    for (int sample = 0; sample < 50; ++sample) {
      const Vec3 point(random.uniform(-1, 1) * half_width, random.uniform(-0.3, 0.3), distance);
      least = std::min(least, height(collider, point, 0));
    }
    REQUIRE(least >= 0.0005 - 1e-12);
    // No further than need be: 2 k t is what its square is larger by.
    const double share = half_width / radius;
    REQUIRE(height(collider, {0, 0, distance}, 0) <= 0.0005 * (1 + share * share));
  }
}

TEST_CASE("contact: penetration is the deepest vertex below a bare surface", "[contact]") {
  std::vector<Collider> solids{cone_collider(limb(), 0.3), ball_collider({0, 1, 0}, 0.2, 0.3)};
  solids[0].motion = turning_motion({0, 0, 1}, {0.1, 0, 0});
  const ContactPass pass(solids, {0.01, {}});
  const Pose pose = solids[0].motion.pose(0.7);
  Positions places(3, 4);
  places.col(0) = pose * Vec3(0.5, 0, 0);
  places.col(1) = pose * Vec3(0, -0.37, 0);  // 0.03 above the lower end
  places.col(2) = Vec3(0, 1.15, 0);          // 0.05 below the ball's top
  places.col(3) = Vec3(0, 1.205, 0);         // 0.005 outside, within the clearance
  const Penetration found = pass.penetration(places, 0.7);
  CHECK(found.n_inside == 2);
  CHECK(found.deepest == VertexId(2));
  CHECK(found.depth == Approx(0.05));
  CHECK(pass.penetration(places.leftCols(1), 0.7).n_inside == 0);
  CHECK_FALSE(pass.penetration(places.leftCols(1), 0.7).deepest.valid());
}

TEST_CASE("contact: rounded cones that make no sense are our bug", "[contact]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto make = [](const RoundedCone& cone) {
    return ContactPass({cone_collider(cone, 0.3)}, {});
  };
  CHECK_NOTHROW(make(limb()));
  RoundedCone wrong = limb();
  wrong.radius_b = 0;
  CHECK_THROWS_AS(make(wrong), ContractError);
  wrong = limb();
  wrong.centre_a.x() = nan;
  CHECK_THROWS_AS(make(wrong), ContractError);
  wrong = limb();
  wrong.half_width_a = -0.1;
  CHECK_THROWS_AS(make(wrong), ContractError);
  wrong = limb();
  wrong.half_width_a = 0.1;
  wrong.across = Vec3(0, 0.1, 1).normalized();
  CHECK_THROWS_AS(make(wrong), ContractError);
}

}  // namespace pleat
