#include "core/fabric/hinge_bending.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "native-tests/support/analytic.h"
#include "native-tests/support/finite_difference.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

using Mat12 = Eigen::Matrix<double, 12, 12>;
const std::vector<Hinge> kHinge = {{{VertexId(0), VertexId(1), VertexId(2), VertexId(3)}, 1.5}};

/// Two flaps on an edge along x, turned against each other by `angle` [rad] and then in space.
Positions flaps_at(double angle) {
  Positions x(3, 4);
  x.col(0) << 0, 0, 0;
  x.col(1) << 1, 0, 0;
  x.col(2) << 0.3, 0.8, 0;
  x.col(3) << 0.9, -0.6 * std::cos(angle), 0.6 * std::sin(angle);
  return Eigen::AngleAxisd(0.9, Vec3(2, -1, 1).normalized()).toRotationMatrix() * x;
}

Positions forces_of(const Positions& x) {
  Positions forces = Positions::Zero(3, x.cols());
  add_hinge_forces(kHinge, x, forces);
  return forces;
}

/// Shapes away from a half turn, where the angle jumps.
std::vector<Positions> smooth_shapes() {
  std::vector<Positions> shapes = {flaps_at(0), flaps_at(0.3), flaps_at(-1.5), flaps_at(kPi - 0.01),
                                   flaps_at(-kPi + 0.01)};
  Random random(2);
  for (int k = 0; k < 6; ++k) shapes.push_back(shaken(flaps_at(k), 0.1, random));
  return shapes;
}

/// Energy of a slightly bent cylinder over that of its closed form, by the hinges whose edge has
/// its middle in a half-open square of cells away from the border: each cell's hinges once.
double cylinder_ratio(Triangulation pattern, double angle) {
  constexpr int kRowCells = 16;
  constexpr int kFrame = 2;  // cells left out all around; what is left has whole periods
  constexpr double kCylinderRadius = 100;  // edges
  constexpr double kSlack = 1e-9;          // share of an edge
  const double row_height = pattern == Triangulation::equilateral ? std::sqrt(0.75) : 1;
  const double shift = pattern == Triangulation::equilateral ? 0.5 : 0;
  const TriangleMesh mesh = triangulated_sheet(pattern, kRowCells, kRowCells, 1);
  const Positions& rest = mesh.rest_positions;
  const auto is_inside = [&](double cells) {
    return cells > kFrame - kSlack && cells < kRowCells - kFrame - kSlack;
  };
  std::vector<Hinge> inner;
  for (const Hinge& hinge : hinges(mesh, 1)) {
    const Vec3 middle = (rest.col(hinge.vertices[0]) + rest.col(hinge.vertices[1])) / 2;
    const double row = middle.y() / row_height;
    if (is_inside(row) && is_inside(middle.x() - shift * row)) inner.push_back(hinge);
  }
  const double area = std::pow(kRowCells - 2 * kFrame, 2) * row_height;
  return hinge_energy(inner, on_cylinder(rest, angle, kCylinderRadius)) /
         (0.5 * area / (kCylinderRadius * kCylinderRadius));
}

}  // namespace

TEST_CASE("hinge_bending: the angle is that by which the flaps are turned", "[fabric]") {
  const double angle = GENERATE(0.0, 1e-7, 0.3, 1.5, 3.0, -2.0);
  CAPTURE(angle);
  CHECK(hinge_energy(kHinge, flaps_at(angle)) ==
        Approx(0.5 * 1.5 * angle * angle).epsilon(1e-8).margin(1e-30));
}

TEST_CASE("hinge_bending: force is the energy's gradient, stiffness its second derivative",
          "[fabric]") {
  for (const Positions& x : smooth_shapes()) {
    CAPTURE(x);
    const auto energy = [](const Eigen::VectorXd& at) {
      return hinge_energy(kHinge, at.reshaped(3, 4));
    };
    const auto force = [](const Eigen::VectorXd& at) -> Eigen::VectorXd {
      return forces_of(at.reshaped(3, 4)).reshaped();
    };
    const Eigen::VectorXd at = x.reshaped();
    const double step = difference_step(1);
    CHECK((force(at) + difference_gradient(energy, at, step)).norm() <
          1e-8 * (1 + force(at).norm()));
    const Mat12 K = hinge_stiffness(kHinge[0], x, ElementHessian::exact);
    CHECK((K + difference_jacobian(force, at, step)).norm() < 1e-8 * K.norm());
    CHECK((K - K.transpose()).norm() == 0);
  }
}

TEST_CASE("hinge_bending: moving and turning costs nothing and pulls nowhere", "[fabric]") {
  const auto pattern = GENERATE(from_range(kTriangulations));
  CAPTURE(pattern);
  const TriangleMesh mesh = triangulated_sheet(pattern, 4, 4, 0.1);
  const std::vector<Hinge> all = hinges(mesh, 1);
  const Mat3 turn = Eigen::AngleAxisd(2.5, Vec3(3, 1, 2).normalized()).toRotationMatrix();
  const Positions moved = (turn * mesh.rest_positions).colwise() + Vec3(1, -2, 3);
  Positions forces = Positions::Zero(3, mesh.n_vertices());
  add_hinge_forces(all, moved, forces);
  CHECK(hinge_energy(all, moved) < 1e-24);
  CHECK(forces.norm() < 1e-11);
}

TEST_CASE("hinge_bending: forces and torques of a hinge sum to zero", "[fabric]") {
  for (const Positions& x : smooth_shapes()) {
    const Positions forces = forces_of(x);
    Vec3 torque = Vec3::Zero();
    for (int i = 0; i < 4; ++i) torque += Vec3(x.col(i)).cross(Vec3(forces.col(i)));
    CAPTURE(x);
    CHECK(forces.rowwise().sum().norm() <= 1e-13 * forces.norm());
    CHECK(torque.norm() <= 1e-13 * forces.norm());
  }
}

TEST_CASE("hinge_bending: the projected stiffness is positive semidefinite and exact when flat",
          "[fabric]") {
  for (const Positions& x : smooth_shapes()) {
    CAPTURE(x);
    const Mat12 projected = hinge_stiffness(kHinge[0], x, ElementHessian::projected);
    const Mat12 dropped = projected - hinge_stiffness(kHinge[0], x, ElementHessian::exact);
    const double tolerance = 1e-13 * projected.norm();
    CHECK(projected.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() >= -tolerance);
    CHECK(dropped.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() >= -tolerance);
    CHECK((projected * dropped).norm() <= tolerance * projected.norm());
  }
  CHECK(relative_error(hinge_stiffness(kHinge[0], flaps_at(0), ElementHessian::projected),
                       hinge_stiffness(kHinge[0], flaps_at(0), ElementHessian::exact)) < 1e-12);
}

TEST_CASE("hinge_bending: folded by a half turn it pushes with the full moment", "[fabric]") {
  Positions x(3, 4);
  x << 0, 1, 0.3, 0.9, 0, 0, 0.8, 0.6, 0, 0, 0, 0;
  CHECK(hinge_energy(kHinge, x) == Approx(0.5 * 1.5 * kPi * kPi));
  const Positions forces = forces_of(x);
  CHECK(forces.col(2).norm() == Approx(1.5 * kPi / 0.8));  // moment over height
  CHECK(forces.col(3).norm() == Approx(1.5 * kPi / 0.6));
  for (const auto kind : {ElementHessian::exact, ElementHessian::projected})
    CHECK(hinge_stiffness(kHinge[0], x, kind).allFinite());
}

TEST_CASE("hinge_bending: a flap without area bends nowhere", "[fabric]") {
  Positions flat = flaps_at(0.5);
  std::vector<Positions> shapes(5, flat);
  shapes[0].col(2) = 0.3 * flat.col(0) + 0.7 * flat.col(1);  // lies on the edge
  shapes[1].col(3) = 2.5 * flat.col(0) - 1.5 * flat.col(1);  // lies on its line
  shapes[2].col(1) = flat.col(0);                            // no edge
  shapes[3].col(2) = flat.col(0);                            // no arm
  shapes[4].colwise() = Vec3(flat.col(0));                   // all in a point
  for (const Positions& x : shapes) {
    CAPTURE(x);
    CHECK(hinge_energy(kHinge, x) == 0);
    CHECK(forces_of(x).isZero(0));
    for (const auto kind : {ElementHessian::exact, ElementHessian::projected})
      CHECK(hinge_stiffness(kHinge[0], x, kind).isZero(0));
  }
}

TEST_CASE("hinge_bending: the stiffness of each mesh depends on direction in closed form",
          "[fabric]") {
  // Sums of (turn about each edge)^2 for z = (x.d)^2 / 2R, with d at `degrees` from the grid.
  const int degrees = GENERATE(range(0, 181, 15));
  CAPTURE(degrees);
  const double angle = degrees * kPi / 180;
  const double s = std::sin(2 * angle);
  const double c = std::cos(2 * angle);
  constexpr double kTurnError = 1e-3;  // remainder of a turn of 0.01 rad over an edge
  CHECK(cylinder_ratio(Triangulation::equilateral, angle) == Approx(1).epsilon(kTurnError));
  CHECK(cylinder_ratio(Triangulation::one_way, angle) == Approx(1 - s + s * s).epsilon(kTurnError));
  CHECK(cylinder_ratio(Triangulation::alternating, angle) ==
        Approx(1 + s * s / 2).epsilon(kTurnError));
  CHECK(cylinder_ratio(Triangulation::crossed, angle) == Approx(1 + c * c / 2).epsilon(kTurnError));
}

TEST_CASE("hinge_bending: bad rigidities and triangles are refused", "[fabric]") {
  TriangleMesh mesh = triangulated_sheet(Triangulation::one_way, 1, 1, 1);
  CHECK_THROWS_AS(hinges(mesh, -1), ContractError);
  CHECK(hinges(mesh, 1).size() == 1);
  mesh.rest_positions.col(0) = mesh.rest_positions.col(1);
  CHECK_THROWS_AS(hinges(mesh, 1), ContractError);
}

}  // namespace pleat
