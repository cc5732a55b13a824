#include "core/body/body_motion.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/base/check.h"
#include "core/base/random.h"
#include "native-tests/support/analytic.h"

namespace pleat {
namespace {

ChannelKeys random_keys(int n) {
  Random random(7);
  ChannelKeys keys(kMotionChannels, n);
  for (Eigen::Index i = 0; i < keys.size(); ++i) keys.data()[i] = random.uniform(-1, 1);
  return keys;
}

/// Every channel's keys lie on the same sine.
ChannelKeys sine_keys(int n) {
  ChannelKeys keys(kMotionChannels, n);
  for (int k = 0; k < n; ++k) keys.col(k).setConstant(std::sin(2 * kPi * k / n));
  return keys;
}

/// Largest distance of the curve through n keys from their sine.
double sine_error(int n) {
  const MotionCurves curves(sine_keys(n));
  double largest = 0;
  for (int i = 0; i < 1000; ++i) {
    const double phase = i / 1000.0;
    largest = std::max(largest, std::abs(curves.at(phase)[0] - std::sin(2 * kPi * phase)));
  }
  return largest;
}

/// Second difference around a phase.
ChannelValues second_difference(const MotionCurves& curves, double phase, double step) {
  return (curves.at(phase + step) - 2 * curves.at(phase) + curves.at(phase - step)) / (step * step);
}

}  // namespace

TEST_CASE("body motion: curves pass through their keys, in every cycle", "[figure]") {
  const int n = GENERATE(4, 5, 50);
  CAPTURE(n);
  const ChannelKeys keys = random_keys(n);
  const MotionCurves curves(keys);
  for (int k = 0; k < n; ++k) {
    const double phase = static_cast<double>(k) / n;
    CHECK((curves.at(phase) - keys.col(k)).norm() < 1e-13);
    CHECK((curves.at(phase + 3) - keys.col(k)).norm() < 1e-12);
    CHECK((curves.at(phase - 2) - keys.col(k)).norm() < 1e-12);
  }
}

TEST_CASE("body motion: what stays is reproduced between keys", "[figure]") {
  ChannelKeys keys(kMotionChannels, 6);
  keys.setConstant(0.7);
  CHECK((MotionCurves(keys).at(0.43) - keys.col(0)).norm() < 1e-14);
}

TEST_CASE("body motion: a sine is met with an error of fourth order", "[figure]") {
  const double order = std::log2(sine_error(16) / sine_error(32));
  CHECK(order == Approx(4).margin(0.1));
}

TEST_CASE("body motion: curvature does not jump at a key nor where the cycle closes", "[figure]") {
  const int n = 12;
  const MotionCurves curves(random_keys(n));
  const double at = GENERATE(0.0, 1.0 / 12, 7.0 / 12);
  CAPTURE(at);
  const auto jump = [&](double step) -> double {
    return (second_difference(curves, at + step, step) - second_difference(curves, at - step, step))
        .norm();
  };
  CHECK(jump(1e-4) == Approx(jump(2e-4) / 2).epsilon(1e-3));
}

TEST_CASE("body motion: too few keys and numbers that are none are refused", "[figure]") {
  BodyMotion motion;
  motion.keys = random_keys(4);
  CHECK_NOTHROW(motion.validate());
  SECTION("three keys") { motion.keys = random_keys(3); }
  SECTION("a key that is no number") {
    motion.keys(3, 1) = std::numeric_limits<double>::quiet_NaN();
  }
  SECTION("a cycle without time") { motion.cycle_time = 0; }
  SECTION("a speed without bound") {
    motion.forward_speed = std::numeric_limits<double>::infinity();
  }
  CHECK_THROWS_AS(motion.validate(), ContractError);
}

}  // namespace pleat
