#include "core/contact/swept_cone.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "native-tests/support/finite_difference.h"
#include "native-tests/support/particle.h"

namespace pleat {
namespace {

/// Height above the nearest of the balls at a share of the cone's axis [m].
double height_at(const RoundedCone& cone, double share, const Vec3& place) {
  const double half_width = cone.half_width_a + share * (cone.half_width_b - cone.half_width_a);
  const Vec3 arm = place - cone.centre_a - share * (cone.centre_b - cone.centre_a);
  const double across = std::clamp(cone.across.dot(arm), -half_width, half_width);
  return (arm - across * cone.across).norm() -
         (cone.radius_a + share * (cone.radius_b - cone.radius_a));
}

/// The least value of a convex function of a share, by thirds.
template <class Function>
double least(const Function& function) {
  double low = 0;
  double high = 1;
  for (int k = 0; k < 90; ++k) {
    const double a = low + (high - low) / 3;
    const double b = high - (high - low) / 3;
    (function(a) < function(b) ? high : low) = function(a) < function(b) ? b : a;
  }
  return std::min({function(0), function(1), function(low)});
}

double height_above(const RoundedCone& cone, const Vec3& place) {
  return least([&](double share) { return height_at(cone, share, place); });
}

SweptCone at_rest(const RoundedCone& cone) { return swept(cone, {}, Vec3::Zero()); }

/// A point of one of the cone's balls.
Vec3 random_point(const RoundedCone& cone, Random& random) {
  const double share = random.uniform(0, 1);
  const double half_width = cone.half_width_a + share * (cone.half_width_b - cone.half_width_a);
  const double radius = cone.radius_a + share * (cone.radius_b - cone.radius_a);
  return cone.centre_a + share * (cone.centre_b - cone.centre_a) +
         random.uniform(-half_width, half_width) * cone.across +
         random.uniform(0, radius) * random_direction(random);
}

}  // namespace

TEST_CASE("contact: a rounded cone's distance is that from its nearest ball", "[contact]") {
  Random random(30);
  for (int trial = 0; trial < 1000; ++trial) {
    const RoundedCone cone = random_cone(random);
    const SweptCone solid = at_rest(cone);
    CAPTURE(trial);
    for (int sample = 0; sample < 10; ++sample) {
      const Vec3 place = cone.centre_a + random.uniform(0, 1.5) * random_direction(random);
      REQUIRE(gap(solid, place).distance == Approx(height_above(cone, place)).margin(1e-12));
    }
    REQUIRE(gap(solid, cone.centre_a).distance ==
            Approx(height_above(cone, cone.centre_a)).margin(1e-12));
  }
}

TEST_CASE("contact: inside of a rounded cone the distance is that to the surface", "[contact]") {
  Random random(31);
  for (int trial = 0; trial < 1000; ++trial) {
    const RoundedCone cone = random_cone(random);
    const SweptCone solid = at_rest(cone);
    const Vec3 place = trial % 10 == 0 ? cone.centre_a : random_point(cone, random);
    const Gap found = gap(solid, place);
    CAPTURE(trial);
    REQUIRE(found.distance <= 1e-15);
    REQUIRE(gap(solid, place - found.distance * found.normal).distance == Approx(0).margin(1e-13));
    for (int sample = 0; sample < 20; ++sample)
      REQUIRE(height_above(cone, place + found.distance * random_direction(random)) < 1e-12);
  }
}

TEST_CASE("contact: a rounded cone's normal is the gradient of its distance", "[contact]") {
  Random random(32);
  for (int trial = 0; trial < 500; ++trial) {
    const SweptCone solid = at_rest(random_cone(random));
    const Eigen::VectorXd place = 1.5 * random_direction(random);
    const Gap found = gap(solid, place);
    if (found.distance < 0.01) continue;
    const Eigen::VectorXd gradient =
        difference_gradient([&](const Eigen::VectorXd& x) { return gap(solid, Vec3(x)).distance; },
                            place, difference_step(0.1));
    CAPTURE(trial);
    CHECK(found.normal.norm() == Approx(1).epsilon(1e-14));
    // Where two parts of the surface join, curvature jumps and the difference errs by its step.
    CHECK((gradient - found.normal).norm() < 1e-5);
  }
}

TEST_CASE("contact: a rounded cone is convex", "[contact]") {
  Random random(33);
  for (int trial = 0; trial < 2000; ++trial) {
    const RoundedCone cone = random_cone(random);
    const double share = random.uniform(0, 1);
    const Vec3 place =
        share * random_point(cone, random) + (1 - share) * random_point(cone, random);
    REQUIRE(gap(at_rest(cone), place).distance < 1e-14);
  }
}

TEST_CASE("contact: a rounded cone is met where bisection says", "[contact]") {
  Random random(34);
  const Clearance inset = GENERATE(Clearance{0, 0}, Clearance{0.004, 0.001});
  const double slack = GENERATE(0.0, 1e-3);
  for (int trial = 0; trial < 500; ++trial) {
    RoundedCone cone = random_cone(random);
    const Vec3 shift = 0.2 * random_direction(random);
    SweptCone solid = swept(cone, {0.005, 0.002}, shift);
    shrink(solid, inset);
    cone.radius_a += 0.005 - inset.at_a;
    cone.radius_b += 0.002 - inset.at_b;
    const Vec3 start = 1.5 * random_direction(random);
    const Vec3 end = random.uniform(0, 1) * random_direction(random);
    const SweptCone held = at_rest(cone);
    const auto height = [&](double share) {
      return gap(held, start + share * (end - start)).distance + slack;
    };
    const double lowest = least(height);
    if (height(0) < 0 || std::abs(lowest) < 1e-9) continue;
    CAPTURE(trial, lowest);
    const auto impact = meeting(solid, start - shift, end, slack).impact;
    REQUIRE(impact.has_value() == (lowest < 0));
    if (!impact) continue;
    // The path is outside before the share that was found and on the surface there.
    CHECK(height(impact->fraction) == Approx(0).margin(1e-11));
    CHECK(least([&](double share) { return height(share * impact->fraction); }) > -1e-11);
    // The point lies on the surface of this vertex, whatever the slack.
    CHECK(gap(held, impact->point).distance == Approx(0).margin(1e-11));
    CHECK(impact->normal.norm() == Approx(1).epsilon(1e-13));
  }
}

// A line that touches the surface, lifted or lowered by a trifle: convexity decides.
TEST_CASE("contact: a path that grazes a rounded cone is met or not", "[contact]") {
  Random random(35);
  const double depth = GENERATE(1e-3, 1e-6, 1e-9, -1e-9, -1e-6, -1e-3);  // [m]
  CAPTURE(depth);
  for (int trial = 0; trial < 300; ++trial) {
    const SweptCone solid = at_rest(random_cone(random));
    const Vec3 place = 1.5 * random_direction(random);
    const Gap above = gap(solid, place);
    const Vec3 on_surface = place - above.distance * above.normal;
    const Vec3 along = above.normal.cross(random_direction(random)).normalized();
    const Vec3 middle = on_surface - depth * above.normal;
    const double length = random.uniform(1, 2);
    const auto impact = meeting(solid, middle - length * along, middle + along, 0).impact;
    CAPTURE(trial);
    REQUIRE(impact.has_value() == (depth > 0));
    if (!impact) continue;
    const Vec3 met = middle + (impact->fraction * (length + 1) - length) * along;
    CHECK(gap(solid, met).distance == Approx(0).margin(1e-11));
    CHECK((impact->point - met).norm() < 1e-11);
  }
}

TEST_CASE("contact: a vertex at rest on a rounded cone may leave it", "[contact]") {
  const RoundedCone cone{{0, 0, 0}, {0, 1, 0}, 0.2, 0.1};
  const Vec3 on_top{0, 1.1, 0};
  CHECK_FALSE(meeting(at_rest(cone), on_top, {0.1, 1.2, 0}, 0).impact);
  CHECK_FALSE(meeting(at_rest(cone), {0, 1.09, 0}, {0.1, 1.2, 0}, 0).impact);
  CHECK(meeting(at_rest(cone), {0, 1.09, 0}, {0, 1.095, 0}, 0).impact->fraction == 0);
  CHECK(meeting(at_rest(cone), on_top, {0, 1.09, 0}, 0).impact->fraction == 0);
}

TEST_CASE("contact: a path that is not finite meets no rounded cone", "[contact]") {
  const double bad =
      GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  const SweptCone solid = at_rest(RoundedCone{});
  CHECK_FALSE(meeting(solid, {0, bad, 0}, {0, 0, 0}, 0).impact);
  CHECK_FALSE(meeting(solid, {0, 5, 0}, {bad, 0, 0}, 0).impact);
}

}  // namespace pleat
