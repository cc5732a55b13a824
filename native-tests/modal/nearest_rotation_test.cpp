#include "core/modal/nearest_rotation.h"

#include <catch2/catch.hpp>

#include "core/base/random.h"

using namespace pleat;

namespace {

Mat3 any_matrix(Random& random) {
  Mat3 F;
  for (double& entry : F.reshaped()) entry = random.uniform(-1, 1);
  return F;
}

}  // namespace

TEST_CASE("nearest_rotation: that of the singular values, however it is found", "[modal]") {
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const Mat3 F = any_matrix(random);
    const RotationSvd svd = rotation_svd(F);
    CAPTURE(i, svd.s.transpose());
    CHECK((svd.U * svd.s.asDiagonal() * svd.V.transpose() - F).norm() < 1e-13);
    // Where two ways to turn are nearly as good, rounding decides.
    if (svd.s[1] + svd.s[2] < 1e-3) continue;
    const Mat3 R = nearest_rotation(F);
    CHECK((R - svd.U * svd.V.transpose()).norm() < 1e-11);
    CHECK((R.transpose() * R - Mat3::Identity()).norm() < 1e-13);
    CHECK(R.determinant() == Approx(1));
  }
}

TEST_CASE("nearest_rotation: nothing, a plane and a mirror image have one too", "[modal]") {
  for (const Vec3& diagonal : {Vec3(0, 0, 0), Vec3(1, 2, 0), Vec3(3, 2, -1), Vec3(1e-9, 1, 1)}) {
    const Mat3 R = nearest_rotation(diagonal.asDiagonal());
    CHECK((R.transpose() * R - Mat3::Identity()).norm() < 1e-13);
    CHECK(R.determinant() == Approx(1));
  }
}
