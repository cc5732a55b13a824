#include "core/contact/contact_pass.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/base/check.h"
#include "native-tests/support/allocation_count.h"
#include "native-tests/support/particle.h"

namespace pleat {
namespace {}  // namespace

TEST_CASE("contact: a vertex that meets nothing is left to the bit", "[contact]") {
  ContactPass pass({floor_collider(0.3), ball_collider({0, 5, 0}, 1, 0.3)}, {});
  pass.begin_substep(0, 1);
  const Vec3 begin{0.1, 1, 0.2};
  Vec3 position{0.7, 0.3, -0.4};
  Vec3 velocity = position - begin;
  CHECK_FALSE(resolve(pass, VertexId(0), begin, position, velocity));
  CHECK(position == Vec3(0.7, 0.3, -0.4));
  CHECK(velocity == Vec3(0.7, 0.3, -0.4) - begin);
}

TEST_CASE("contact: without friction an impact keeps the tangential motion", "[contact]") {
  ContactPass pass({floor_collider(0)}, {0.01, {}});
  pass.begin_substep(0, 0.1);
  const Vec3 begin{0, 0.11, 0};
  Vec3 velocity{3, -4, 1};
  Vec3 position = begin + 0.1 * velocity;
  CHECK(resolve(pass, VertexId(0), begin, position, velocity));
  CHECK((position - Vec3(0.3, 0.01, 0.1)).norm() < 1e-15);
  CHECK((velocity - Vec3(3, 0, 1)).norm() < 1e-15);
}

TEST_CASE("contact: a vertex dropped on a floor comes to rest at once and stays", "[contact]") {
  ContactPass pass({floor_collider(0.3)}, {0.001, {}});
  Particle particle{{0.2, 0.5, 0.3}, {0.4, 0, 0}};
  const double h = 1.0 / 60;
  Vec3 settled = Vec3::Zero();
  for (int k = 0; k < 660; ++k) {
    step(pass, -kGravity * kUp, k * h, h, particle);
    if (k == 60) settled = particle.position;
    if (k >= 60) REQUIRE((particle.velocity == Vec3(0, 0, 0) && particle.position == settled));
  }
  CHECK(settled.y() == Approx(0.001).epsilon(1e-13));
}

TEST_CASE("contact: neither a far solid nor their order changes a bit", "[contact]") {
  Random random(14);
  const Collider ball = ball_collider({0, 0.3, 0}, 0.3, 0.2);
  const Collider ground = floor_collider(0.4);
  const Collider far = ball_collider({100, 0, 0}, 1, 0);
  ContactPass one({ball, ground}, {});
  ContactPass other({far, ground, ball}, {});
  one.begin_substep(0, 0.1);
  other.begin_substep(0, 0.1);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 begin{random.uniform(-1, 1), random.uniform(0.7, 1), random.uniform(-1, 1)};
    const Vec3 velocity_before = 15 * random_direction(random) - Vec3(0, 10, 0);
    Vec3 position_one = begin + 0.1 * velocity_before;
    Vec3 position_other = position_one;
    Vec3 velocity_one = velocity_before;
    Vec3 velocity_other = velocity_before;
    resolve(one, VertexId(0), begin, position_one, velocity_one);
    resolve(other, VertexId(0), begin, position_other, velocity_other);
    CHECK((position_one == position_other && velocity_one == velocity_other));
  }
}

TEST_CASE("contact: a mirrored vertex has the mirrored answer, to the bit", "[contact]") {
  Random random(15);
  const Vec3 mirror(-1, 1, 1);
  ContactPass pass({floor_collider(0.4), ball_collider({0, 0.3, 0.1}, 0.3, 0.2)},
                   {0.001, Eigen::VectorXd::Constant(1, 0.01)});
  pass.begin_substep(0, 0.1);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 begin{random.uniform(-1, 1), random.uniform(0.7, 1), random.uniform(-1, 1)};
    Vec3 velocity = 15 * random_direction(random) - Vec3(0, 10, 0);
    Vec3 position = begin + 0.1 * velocity;
    Vec3 mirrored_position = position.cwiseProduct(mirror);
    Vec3 mirrored_velocity = velocity.cwiseProduct(mirror);
    resolve(pass, VertexId(0), begin, position, velocity);
    resolve(pass, VertexId(0), begin.cwiseProduct(mirror), mirrored_position, mirrored_velocity);
    CHECK(mirrored_position == position.cwiseProduct(mirror));
    CHECK(mirrored_velocity == velocity.cwiseProduct(mirror));
  }
}

TEST_CASE("contact: only the motion relative to the solid counts", "[contact]") {
  Random random(16);
  const Vec3 drift(7, -3, 2);  // [m/s]
  Collider ball = ball_collider({0, 0, 0}, 0.5, 0.3);
  ContactPass at_rest({ball}, {});
  ball.motion = steady_motion(drift);
  ContactPass moving({ball}, {});
  at_rest.begin_substep(0, 0.1);
  moving.begin_substep(0, 0.1);
  for (int trial = 0; trial < 100; ++trial) {
    const Vec3 begin = 0.8 * random_direction(random);
    Vec3 velocity = -8 * begin + 3 * random_direction(random);
    Vec3 position = begin + 0.1 * velocity;
    Vec3 moving_velocity = velocity + drift;
    Vec3 moving_position = position + 0.1 * drift;
    REQUIRE(resolve(at_rest, VertexId(0), begin, position, velocity) ==
            resolve(moving, VertexId(0), begin, moving_position, moving_velocity));
    CHECK((moving_velocity - drift - velocity).norm() < 1e-13);
    CHECK((moving_position - 0.1 * drift - position).norm() < 1e-13);
  }
}

TEST_CASE("contact: a vertex that is not finite is left for the stepper to report", "[contact]") {
  const double bad =
      GENERATE(std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity());
  ContactPass pass({floor_collider(0.3), ball_collider({0, 0, 0}, 1, 0.3)}, {});
  pass.begin_substep(0, 0.1);
  const int broken = GENERATE(0, 1, 2);
  CAPTURE(bad, broken);
  Vec3 begin{0, 2, 0};
  Vec3 position{0, -0.5, 0};
  Vec3 velocity{0, -25, 0};
  (broken == 0 ? begin : broken == 1 ? position : velocity).y() = bad;
  const Vec3 position_before = position;
  CHECK_FALSE(resolve(pass, VertexId(0), begin, position, velocity));
  CHECK(position.x() == 0);
  CHECK((position.y() == position_before.y() || std::isnan(bad)));
}

TEST_CASE("contact: colliders and sizes that make no sense are our bug", "[contact]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto make = [](const Collider& collider) { return ContactPass({collider}, {}); };
  CHECK_THROWS_AS(make(ball_collider({0, 0, 0}, 0, 0.3)), ContractError);
  CHECK_THROWS_AS(make(ball_collider({0, 0, 0}, nan, 0.3)), ContractError);
  CHECK_THROWS_AS(make(ball_collider({0, nan, 0}, 1, 0.3)), ContractError);
  CHECK_THROWS_AS(make(floor_collider(-0.1)), ContractError);
  CHECK_THROWS_AS(make(floor_collider(nan)), ContractError);
  Collider slanted = floor_collider(0);
  slanted.shape = Plane{Vec3::Zero(), {0, 1.01, 0}};
  CHECK_THROWS_AS(make(slanted), ContractError);
  CHECK_THROWS_AS(ContactPass({}, {-1, {}}), ContractError);
  CHECK_THROWS_AS(ContactPass({}, {0, Eigen::VectorXd::Constant(1, nan)}), ContractError);
  ContactPass pass({floor_collider(0)}, {});
  CHECK_THROWS_AS(pass.begin_substep(1, 1), ContractError);
}

TEST_CASE("contact: a substep allocates nothing", "[contact]") {
  if (!counts_allocations()) return;
  ContactPass pass({floor_collider(0.3), ball_collider({0, 0.3, 0}, 0.3, 0.3)},
                   {0.001, Eigen::VectorXd::Constant(1, 0.01)});
  Particle particle{{0.5, 0.05, 0}, {-20, 0, 0}};
  step(pass, Vec3(-100, -kGravity, 0), 0, 1 / 60.0, particle);
  CHECK(allocations_in([&] {
          for (int k = 1; k < 50; ++k)
            step(pass, Vec3(-100, -kGravity, 0), k / 60.0, 1 / 60.0, particle);
        }) == 0);
}

TEST_CASE("contact: a whole state gets what its vertices get one by one, to the bit", "[contact]") {
  Random random(19);
  constexpr int kVertices = 300;
  Collider limb = cone_collider({{-0.4, 0.5, 0}, {0.4, 0.6, 0}, 0.2, 0.1}, 0.3);
  limb.motion = turning_motion({0, 2, 1}, {0.5, 0, 0});
  Collider ball = ball_collider({0, 0.3, 0.4}, 0.3, 0.2);
  ball.motion = steady_motion({0, 0.4, 0});
  const ContactOptions options{0.001, Eigen::VectorXd::LinSpaced(kVertices, 0, 0.02)};
  ContactPass together({floor_collider(0.4), limb, ball}, options);
  ContactPass one_by_one = together;
  Positions begin(3, kVertices);
  for (int i = 0; i < kVertices; ++i)
    begin.col(i) = Vec3(0, 0.5, 0) + random.uniform(0, 1) * random_direction(random);
  std::vector<char> is_exempt(kVertices, 0);
  for (int i = 0; i < kVertices; i += 7) is_exempt[static_cast<std::size_t>(i)] = 1;
  int n_touches = 0;
  for (int k = 0; k < 20; ++k) {
    const double h = 0.02;
    Positions velocities(3, kVertices);
    for (int i = 0; i < kVertices; ++i) velocities.col(i) = 8 * random_direction(random);
    Positions positions = begin + h * velocities;
    positions(1, 5) = velocities(2, 6) = std::numeric_limits<double>::quiet_NaN();
    Positions expected_positions = positions;
    Positions expected_velocities = velocities;
    together.begin_substep(k * h, (k + 1) * h);
    one_by_one.begin_substep(k * h, (k + 1) * h);
    const auto touches = together.resolve(begin, is_exempt, positions, velocities);
    auto touch = touches.begin();
    for (int i = 0; i < kVertices; ++i) {
      if (is_exempt[static_cast<std::size_t>(i)] != 0) continue;
      std::vector<char> others(kVertices, 1);
      others[static_cast<std::size_t>(i)] = 0;
      for (const ContactPass::Touch& expected :
           one_by_one.resolve(begin, others, expected_positions, expected_velocities)) {
        REQUIRE(touch != touches.end());
        CHECK((touch->vertex == i && touch->solid == expected.solid &&
               touch->normal == expected.normal && touch->sticks == expected.sticks));
        ++touch;
        ++n_touches;
      }
    }
    CHECK(touch == touches.end());
    const auto same_bits = [](const Positions& a, const Positions& b) {
      return std::memcmp(a.data(), b.data(), sizeof(double) * 3 * kVertices) == 0;
    };
    CHECK(same_bits(positions, expected_positions));
    CHECK(same_bits(velocities, expected_velocities));
    CHECK(positions.col(7) == begin.col(7) + h * velocities.col(7));
    CHECK(std::isnan(positions(1, 5)));
    for (int i = 0; i < kVertices; ++i)
      if (positions.col(i).allFinite()) begin.col(i) = positions.col(i);
  }
  CHECK(n_touches > 500);
}

/// False where every outline says that the way does not meet its solid.
bool may_meet(const std::vector<ContactPass::Outline>& outlines, const Vec3& begin,
              const Vec3& end) {
  const Vec3 middle = (begin + end) / 2;
  const double length = (end - begin).norm();
  return std::any_of(outlines.begin(), outlines.end(), [&](const ContactPass::Outline& outline) {
    if (const auto* ball = std::get_if<SweptSphere>(&outline.shape))
      return (middle - ball->centre + ball->shift / 2).norm() <=
             ball->radius + length + ball->shift.norm() / 2;
    const auto& plane = std::get<SweptPlane>(outline.shape);
    return plane.normal.dot(middle) - plane.level <= length;
  });
}

TEST_CASE("contact: what is out of a solid's outline does not meet it", "[contact]") {
  Random random(23);
  constexpr double kStep = 0.02;
  Collider limb = cone_collider({{-0.4, 0.5, 0}, {0.4, 0.6, 0}, 0.2, 0.1}, 0.3);
  limb.motion = turning_motion({0, 6, 2}, {0.5, 0, 0});
  Collider ball = ball_collider({0, 0.3, 0.9}, 0.3, 0.2);
  ball.motion = turning_motion({8, 0, 0}, {0, 0, -0.5});
  Collider floor = floor_collider(0.4);
  floor.motion = steady_motion({0, -1, 0});
  ContactPass pass({floor, limb, ball}, {0.001, Eigen::VectorXd::Constant(1, 0.02)});
  std::vector<ContactPass::Outline> outlines;
  int n_ruled_out = 0;
  int n_touched = 0;
  for (int k = 0; k < 20; ++k) {
    pass.begin_substep(k * kStep, (k + 1) * kStep);
    pass.outlines(outlines);
    REQUIRE(outlines.size() == 3);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 begin = Vec3(0, 0.8, 0) + random.uniform(0, 1.5) * random_direction(random);
      Vec3 velocity = 20 * std::pow(random.uniform(0, 1), 4) * random_direction(random);
      Vec3 end = begin + kStep * velocity;
      const bool is_ruled_out = !may_meet(outlines, begin, end);
      const bool is_touched = pass.resolve(VertexId(0), begin, end, velocity).has_value();
      CHECK_FALSE((is_ruled_out && is_touched));
      n_ruled_out += is_ruled_out ? 1 : 0;
      n_touched += is_touched ? 1 : 0;
    }
  }
  CHECK(n_ruled_out > 8000);
  CHECK(n_touched > 2000);
}

TEST_CASE("contact: a state that is not whole is refused", "[contact]") {
  ContactPass pass({floor_collider(0)}, {});
  pass.begin_substep(0, 1);
  const Positions begin = Positions::Zero(3, 2);
  Positions positions = begin;
  Positions velocities = begin;
  CHECK_THROWS_AS(pass.resolve(begin, std::vector<char>(1, 0), positions, velocities),
                  ContractError);
  velocities.resize(3, 1);
  CHECK_THROWS_AS(pass.resolve(begin, std::vector<char>(2, 0), positions, velocities),
                  ContractError);
}

TEST_CASE("contact: a vertex on a solid is supported by it", "[contact]") {
  const ContactPass pass({floor_collider(0.4), ball_collider({0, 0.3, 0}, 0.3, 0.2)},
                         {0.001, Eigen::VectorXd::Constant(3, 0.01)});
  Positions positions(3, 3);
  positions.col(0) = Vec3(2, 0.001, 0);  // touches the floor
  positions.col(1) = Vec3(0, 0.6 + pass.clearance(pass.colliders()[1], VertexId(1)).at_a, 0);
  positions.col(2) = Vec3(2, 0.001 + 2 * kTouchDistance, 0);  // is above it
  const auto supports = pass.supports(positions, 0);
  REQUIRE(supports.size() == 2);
  CHECK((supports[0].vertex == 0 && supports[0].normal == kUp && supports[0].friction == 0.4));
  CHECK((supports[1].vertex == 1 && supports[1].normal == kUp && supports[1].friction == 0.2));
}

}  // namespace pleat
