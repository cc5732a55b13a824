#include "core/body/body_section.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/base/check.h"
#include "native-tests/support/analytic.h"

namespace pleat {
namespace {

using Parts = std::vector<BodyPart>;

Parts only(const RoundedCone& shape) { return {{"one", shape, Bone::pelvis}}; }

}  // namespace

TEST_CASE("body section: a ball's section is the circle at that height", "[figure]") {
  const Parts ball = only({{0.1, 1, 0}, {0.1, 1, 0}, 0.5, 0.5, {0, 0, 1}, 0, 0});
  const Outline section = outline(ball, 1.3, 360);
  CHECK(section[0] == Approx(0.5).epsilon(1e-12));    // 0.1 + 0.4 ahead
  CHECK(section[180] == Approx(0.3).epsilon(1e-12));  // 0.4 - 0.1 behind
  CHECK(section[90] == Approx(0.4).epsilon(1e-12));
  CHECK(girth(section) == Approx(2 * kPi * 0.4).epsilon(1e-12));
}

TEST_CASE("body section: a tape around a capsule across goes straight between its ends",
          "[figure]") {
  const Parts capsule = only({{0, 1, 0.2}, {0, 1, 0.2}, 0.1, 0.1, {0, 0, 1}, 0.06, 0.06});
  const Outline section = outline(capsule, 1, 720);
  CHECK(section[180] == Approx(-0.04).epsilon(1e-12));  // the left end
  CHECK(section[540] == Approx(0.36).epsilon(1e-12));
  CHECK(girth(section) == Approx(2 * kPi * 0.1 + 4 * 0.06).epsilon(1e-4));
}

TEST_CASE("body section: a cone's section is wider by its slope", "[figure]") {
  // r = 0.3 - 0.2 y, so sin = 0.2 and the surface at height 0.5 is 0.2 / cos from the axis.
  const Parts cone = only({{0, 0, 0}, {0, 1, 0}, 0.3, 0.1, {0, 0, 1}, 0, 0});
  CHECK(outline(cone, 0.5, 8)[3] == Approx(0.2 / std::sqrt(1 - 0.04)).epsilon(1e-12));
}

TEST_CASE("body section: a tape spans what lies between two parts", "[figure]") {
  Parts two = only({{0, 0, 0.3}, {0, 1, 0.3}, 0.1, 0.1, {1, 0, 0}, 0, 0});
  two.push_back({"other", {{0, 0, -0.3}, {0, 1, -0.3}, 0.1, 0.1, {1, 0, 0}, 0, 0}, Bone::pelvis});
  CHECK(girth(outline(two, 0.5, 720)) == Approx(2 * kPi * 0.1 + 4 * 0.3).epsilon(1e-4));
  CHECK_THROWS_AS(outline(two, 1.2, 8), ContractError);
}

TEST_CASE("body section: clearance is the distance from a widened cone", "[figure]") {
  const Parts cone = only({{0, 0, 0}, {0, 1, 0}, 0.3, 0.1, {0, 0, 1}, 0.2, 0.1});
  const double cosine = std::sqrt(1 - 0.04);
  // Beside the middle, within the width, the section across x is a cone of sin 0.2.
  CHECK(clearance(cone, {1, 0.5, 0.1}) == Approx(cosine - 0.2).epsilon(1e-12));
  CHECK(clearance(cone, {0, 1.4, 0.1}) == Approx(0.3).epsilon(1e-12));
  CHECK(clearance(cone, {0, -0.7, 0.4}) == Approx(std::sqrt(0.49 + 0.04) - 0.3).epsilon(1e-12));
  // Balls of all radii meet on the axis at half height; the nearest surface is that of the slope.
  CHECK(clearance(cone, {0, 0.5, 0}) == Approx(-0.2).margin(0.01));
}

TEST_CASE("body section: a ring's points lie at equal distances on the offset curve", "[figure]") {
  const Parts ball = only({{0.1, 1, 0}, {0.1, 1, 0}, 0.5, 0.5, {0, 0, 1}, 0, 0});
  const int n = 12;
  const std::vector<Vec3> points = ring(outline(ball, 1, 3600), 0.02, 1.3, n);
  REQUIRE(points.size() == n);
  CHECK((points[0] - Vec3(0.62, 1.3, 0)).norm() < 1e-6);
  CHECK((points[3] - Vec3(0.1, 1.3, -0.52)).norm() < 1e-3);  // the left comes next
  for (std::size_t i = 0; i < n; ++i) {
    CHECK((points[i] - Vec3(0.1, 1.3, 0)).norm() == Approx(0.52).epsilon(1e-6));
    CHECK((points[i] - points[(i + 1) % n]).norm() ==
          Approx(2 * 0.52 * std::sin(kPi / n)).epsilon(1e-5));
  }
}

}  // namespace pleat
