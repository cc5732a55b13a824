#include "core/base/motion.h"

#include <catch2/catch.hpp>

namespace pleat {

TEST_CASE("motion: every kind starts at its place", "[base]") {
  const auto kind =
      GENERATE(Motion::Kind::hold, Motion::Kind::move, Motion::Kind::ease, Motion::Kind::oscillate);
  const Motion motion{kind, {1, 2, 3}, 0.5, 1.5, 2};
  CHECK(motion.displacement(0).isZero());
  CHECK(motion.displacement(0.5).isZero());
}

TEST_CASE("motion: move and ease reach their offset and stay", "[base]") {
  const auto kind = GENERATE(Motion::Kind::move, Motion::Kind::ease);
  const Motion motion{kind, {1, 2, 3}, 0.5, 1.5, 0};
  CHECK(motion.displacement(1) == Vec3(0.5, 1, 1.5));  // both are symmetric in time
  CHECK(motion.displacement(1.5) == Vec3(1, 2, 3));
  CHECK(motion.displacement(9) == Vec3(1, 2, 3));
}

TEST_CASE("motion: move keeps its speed, ease starts and ends at rest", "[base]") {
  constexpr double kTiny = 1e-6;  // [s]
  const Motion move{Motion::Kind::move, {1, 0, 0}, 0, 2, 0};
  CHECK(move.displacement(kTiny).x() == Approx(kTiny / 2));
  const Motion ease{Motion::Kind::ease, {1, 0, 0}, 0, 2, 0};
  CHECK(ease.displacement(kTiny).x() < 1e-5 * kTiny);
  CHECK(1 - ease.displacement(2 - kTiny).x() < 1e-5 * kTiny);
}

TEST_CASE("motion: a move without duration is a jump", "[base]") {
  const Motion motion{Motion::Kind::move, {1, 0, 0}, 1, 1, 0};
  CHECK(motion.displacement(0.999).x() == 0);
  CHECK(motion.displacement(1).x() == 1);
}

TEST_CASE("motion: oscillate swings by its offset with its frequency", "[base]") {
  const Motion motion{Motion::Kind::oscillate, {0, 0.2, 0}, 1, 0, 4};
  CHECK(motion.displacement(1 + 1.0 / 16).y() == Approx(0.2));
  CHECK(motion.displacement(1 + 3.0 / 16).y() == Approx(-0.2));
  CHECK(std::abs(motion.displacement(1.25).y()) < 1e-15);
}

TEST_CASE("motion: the velocity is the displacement's rate", "[base]") {
  Motion motion;
  motion.kind =
      GENERATE(Motion::Kind::hold, Motion::Kind::move, Motion::Kind::ease, Motion::Kind::oscillate);
  motion.offset = {0.3, -1, 2};
  motion.time_begin = 0.5;
  motion.time_end = 1.5;
  motion.frequency = 0.7;
  constexpr double kHalfStep = 1e-6;  // [s]
  for (const double time : {0.2, 0.6, 1.1, 1.4, 1.9}) {
    CAPTURE(time);
    const Vec3 expected =
        (motion.displacement(time + kHalfStep) - motion.displacement(time - kHalfStep)) /
        (2 * kHalfStep);
    CHECK((motion.velocity(time) - expected).norm() < 1e-8);
  }
}

}  // namespace pleat
