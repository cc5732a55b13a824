#include "core/deform/cloth_extent.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "native-tests/support/analytic.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

constexpr double kFace = 0.05;  // [m]

}  // namespace

TEST_CASE("cloth extent: of a rectangle it is the diagonal, however it lies and is cut",
          "[deform]") {
  const Triangulation pattern =
      GENERATE(Triangulation::one_way, Triangulation::alternating, Triangulation::crossed);
  const int n_along = GENERATE(8, 20);
  const double far = GENERATE(0.0, 1e6);  // [m]
  CAPTURE(pattern, n_along, far);
  TriangleMesh mesh = triangulated_sheet(pattern, n_along, 8, kFace);
  const Mat3 turn = Eigen::AngleAxisd(0.8, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  mesh.rest_positions = (turn * mesh.rest_positions).colwise() + Vec3(far, -far, far);
  CHECK(cloth_extent(mesh) == Approx(kFace * std::hypot(n_along, 8)).epsilon(1e-8));
}

TEST_CASE("cloth extent: of a tube it is that of its surface", "[deform]") {
  constexpr int kAround = 200;
  TriangleMesh mesh = triangulated_sheet(Triangulation::alternating, 20, kAround, kFace);
  const double radius = kAround * kFace / (2 * kPi);
  const double length = 20 * kFace;
  for (auto x : mesh.rest_positions.colwise())
    x = Vec3(radius * std::cos(x.x() / radius), radius * std::sin(x.x() / radius), x.y());
  CHECK(cloth_extent(mesh) ==
        Approx(std::sqrt(12 * radius * radius + length * length)).epsilon(1e-3));
}

TEST_CASE("cloth extent: cloth without area is refused", "[deform]") {
  TriangleMesh mesh = triangulated_sheet(Triangulation::one_way, 2, 2, kFace);
  mesh.rest_positions.row(1).setZero();
  CHECK_THROWS_AS(cloth_extent(mesh), ContractError);
  CHECK_THROWS_AS(cloth_extent(TriangleMesh{}), ContractError);
}

}  // namespace pleat
