#include "core/base/rigid_motion.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/base/random.h"
#include "native-tests/support/analytic.h"

namespace pleat {
namespace {

const Vec3 kShift(3, -1, 2);

Mat3 turn(double degrees) {
  return Eigen::AngleAxisd(degrees * kPi / 180, Vec3(1, -2, 3).normalized()).toRotationMatrix();
}

/// Anywhere in space, in a plane, on a line.
Positions places(int n_dimensions) {
  Random random(5);
  Positions x = Positions::Zero(3, 6);
  for (auto place : x.colwise())
    for (int k = 0; k < n_dimensions; ++k) place[k] = random.uniform(-1, 1);
  return turn(50) * x;
}

}  // namespace

TEST_CASE("rigid motion: a motion of places that are not on a line is found", "[base]") {
  const int n_dimensions = GENERATE(2, 3);
  const double degrees = GENERATE(0.0, 20.0, 150.0, 180.0);
  CAPTURE(n_dimensions, degrees);
  const Positions before = places(n_dimensions);
  const Positions after = (turn(degrees) * before).colwise() + kShift;
  const RigidMotion motion = nearest_rigid_motion(before, after);
  CHECK(motion.angle() == Approx(degrees * kPi / 180).margin(1e-5));
  CHECK((motion.of(before) - after).norm() < 1e-5 * before.norm());
}

TEST_CASE("rigid motion: a reflection is answered by a rotation", "[base]") {
  const Positions before = places(3);
  const Positions after = Vec3(1, 1, -1).asDiagonal() * before;
  const RigidMotion motion = nearest_rigid_motion(before, after);
  CHECK(motion.rotation.determinant() == Approx(1));
  CHECK((motion.rotation * motion.rotation.transpose()).isIdentity(1e-12));
}

TEST_CASE("rigid motion: what a line leaves free does not turn", "[base]") {
  const Positions before = places(1);
  const Vec3 along = (before.col(0) - before.col(1)).normalized();
  const Vec3 across = along.unitOrthogonal();
  const Positions after = Eigen::AngleAxisd(2.0, across).toRotationMatrix() * before;
  const RigidMotion motion = nearest_rigid_motion(before, after);
  CHECK((motion.of(before) - after).norm() < 1e-5 * before.norm());
  CHECK((motion.rotation * across - across).norm() < 1e-5);
  const RigidMotion shift = nearest_rigid_motion(before.col(0), before.col(0) + kShift);
  CHECK(shift.angle() == 0);
  CHECK(shift.of(before).isApprox(before.colwise() + kShift));
}

}  // namespace pleat
