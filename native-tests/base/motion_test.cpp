#include "core/base/motion.h"

#include <catch2/catch.hpp>

namespace pleat {

TEST_CASE("motion: every kind starts at its place", "[base]") {
  const auto kind =
      GENERATE(Motion::Kind::hold, Motion::Kind::move, Motion::Kind::ease, Motion::Kind::oscillate);
  const Motion motion{kind, {1, 2, 3}, 0.5, 1.5, 2};
  CHECK(motion.pose(0).translation.isZero());
  CHECK(motion.pose(0.5).translation.isZero());
}

TEST_CASE("motion: move and ease reach their offset and stay", "[base]") {
  const auto kind = GENERATE(Motion::Kind::move, Motion::Kind::ease);
  const Motion motion{kind, {1, 2, 3}, 0.5, 1.5, 0};
  CHECK(motion.pose(1).translation == Vec3(0.5, 1, 1.5));  // both are symmetric in time
  CHECK(motion.pose(1.5).translation == Vec3(1, 2, 3));
  CHECK(motion.pose(9).translation == Vec3(1, 2, 3));
}

TEST_CASE("motion: move keeps its speed, ease starts and ends at rest", "[base]") {
  constexpr double kTiny = 1e-6;  // [s]
  const Motion move{Motion::Kind::move, {1, 0, 0}, 0, 2, 0};
  CHECK(move.pose(kTiny).translation.x() == Approx(kTiny / 2));
  const Motion ease{Motion::Kind::ease, {1, 0, 0}, 0, 2, 0};
  CHECK(ease.pose(kTiny).translation.x() < 1e-5 * kTiny);
  CHECK(1 - ease.pose(2 - kTiny).translation.x() < 1e-5 * kTiny);
}

TEST_CASE("motion: a move without duration is a jump", "[base]") {
  const Motion motion{Motion::Kind::move, {1, 0, 0}, 1, 1, 0};
  CHECK(motion.pose(0.999).translation.x() == 0);
  CHECK(motion.pose(1).translation.x() == 1);
}

TEST_CASE("motion: oscillate swings by its offset with its frequency", "[base]") {
  const Motion motion{Motion::Kind::oscillate, {0, 0.2, 0}, 1, 0, 4};
  CHECK(motion.pose(1 + 1.0 / 16).translation.y() == Approx(0.2));
  CHECK(motion.pose(1 + 3.0 / 16).translation.y() == Approx(-0.2));
  CHECK(std::abs(motion.pose(1.25).translation.y()) < 1e-15);
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
        (motion.pose(time + kHalfStep).translation - motion.pose(time - kHalfStep).translation) /
        (2 * kHalfStep);
    CHECK((motion.velocity(Vec3(1, 2, 3), time) - expected).norm() < 1e-8);
  }
}

namespace {

/// Counterclockwise round a line through (1, 2, 3) along y, which points up.
Motion round_a_line(double rate) {
  Motion motion;
  motion.kind = Motion::Kind::turn;
  motion.centre = {1, 2, 3};
  motion.axis = Vec3::UnitY();
  motion.rate = rate;
  motion.time_begin = 0.5;
  motion.time_end = 2.5;
  return motion;
}

}  // namespace

TEST_CASE("motion: what turns is on its circle, and goes along it", "[base]") {
  const double rate = GENERATE(-0.7, 3.0, 40.0);  // [rad/s]
  const Motion motion = round_a_line(rate);
  const Vec3 place = motion.centre + Vec3(2, 0.4, 0);
  for (const double time : {0.5, 0.9, 2.0, 2.4999}) {
    CAPTURE(rate, time);
    const double angle = rate * (time - 0.5);
    const Vec3 arm(2 * std::cos(angle), 0.4, -2 * std::sin(angle));
    CHECK((motion.pose(time) * place - motion.centre - arm).norm() < 1e-14);
    const Vec3 along(arm.z(), 0, -arm.x());  // y x arm
    CHECK((motion.velocity(place, time) - rate * along).norm() < 1e-13 * std::abs(rate));
  }
}

TEST_CASE("motion: what turns rests before and after, where it then is", "[base]") {
  const Motion motion = round_a_line(3);
  const Vec3 place = motion.centre + Vec3(2, 0, 0);
  for (const double time : {0.0, 0.5}) CHECK(motion.pose(time) * place == place);
  for (const double time : {2.5, 99.0}) {
    CHECK((motion.pose(time) * place - motion.centre - Vec3(2 * std::cos(6), 0, -2 * std::sin(6)))
              .norm() < 1e-14);
    CHECK(motion.velocity(place, time).isZero(0));
  }
  CHECK(motion.velocity(place, 0.4).isZero(0));
  CHECK(motion.velocity(place, 0.5) == Vec3(0, 0, -6));
}

TEST_CASE("motion: what turns about any line keeps that line and all distances", "[base]") {
  Motion motion = round_a_line(5);
  motion.axis = Vec3(1, -2, 2) / 3;
  const Pose pose = motion.pose(1.7);
  for (const double along : {-3.0, 0.0, 0.2}) {
    const Vec3 place = motion.centre + along * motion.axis;
    CHECK((pose * place - place).norm() < 1e-14);
    CHECK(motion.velocity(place, 1.7).norm() < 1e-13);
  }
  CHECK((pose.rotation * pose.rotation.transpose() - Mat3::Identity()).norm() < 1e-14);
  CHECK(pose.rotation.trace() == Approx(1 + 2 * std::cos(5 * 1.2)));
}

TEST_CASE("motion: only a turn and a frame turn", "[base]") {
  const auto kind = GENERATE(Motion::Kind::hold, Motion::Kind::move, Motion::Kind::ease,
                             Motion::Kind::oscillate, Motion::Kind::turn, Motion::Kind::follow);
  Motion motion;
  motion.kind = kind;
  CHECK(motion.turns() == (kind == Motion::Kind::turn || kind == Motion::Kind::follow));
}

TEST_CASE("motion: what follows a turning frame moves across its arm", "[base]") {
  struct Turntable : MovingFrame {
    Pose pose(double time) const override {
      return {Eigen::AngleAxisd(3 * time, Vec3::UnitY()).toRotationMatrix(), Vec3(0, time, 0)};
    }
  };
  Motion motion;
  motion.kind = Motion::Kind::follow;
  motion.frame = std::make_shared<Turntable>();
  const Vec3 place(2, 0, 0);
  CHECK((motion.pose(0.5) * place - Vec3(2 * std::cos(1.5), 0.5, -2 * std::sin(1.5))).norm() <
        1e-15);
  CHECK((motion.velocity(place, 0.5) - Vec3(-6 * std::sin(1.5), 1, -6 * std::cos(1.5))).norm() <
        1e-8);
}

TEST_CASE("pose: a pose and its inverse take a point there and back", "[base]") {
  const Pose turn{Eigen::AngleAxisd(0.7, Vec3(1, 2, 2) / 3).toRotationMatrix(), Vec3(1, -2, 3)};
  const Pose shift{Mat3::Identity(), Vec3(0, 5, 0)};
  const Vec3 x(0.3, 0.2, -0.9);
  CHECK((turn.inverse() * (turn * x) - x).norm() < 1e-15);
  CHECK(((turn * shift) * x - turn * (shift * x)).norm() < 1e-15);
}

}  // namespace pleat
