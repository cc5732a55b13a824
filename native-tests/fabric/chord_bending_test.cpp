#include "core/fabric/chord_bending.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/fabric/spring_lattice.h"
#include "native-tests/support/finite_difference.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

constexpr double kArm = 0.05;       // L [m]
constexpr double kRigidity = 2e-5;  // B w [N m^2]

std::vector<ChordBend> bend_between_two() {
  return {chord_bend(VertexId(0), VertexId(1), kArm, kRigidity)};
}

/// Two vertices at a distance of `ratio` times 2L, in no special direction.
Positions vertices_at(double ratio) {
  Positions x(3, 2);
  x.col(0) << 0.3, -0.2, 0.1;
  x.col(1) = Vec3(x.col(0)) + ratio * 2 * kArm * Vec3(2, -1, 2) / 3;
  return x;
}

Positions forces_of(const std::vector<ChordBend>& bends, const Positions& x) {
  Positions forces = Positions::Zero(3, x.cols());
  add_chord_forces(bends, x, forces);
  return forces;
}

/// Energy of a chord between arms L that a curvature turns against each other by 2 phi = kappa L:
/// 1/2 B w L kappa^2 at kappa0 [J]. 2L - c = 4 L sin^2(phi/2).
double stored(double rigidity, double arm, double kappa) {
  const double half = kappa * arm / 4;  // phi/2
  const double share = std::pow(kappa / 30, 2) * std::pow(std::sin(half) / half, 4);
  return 0.5 * rigidity * arm * kappa * kappa * share;
}

}  // namespace

TEST_CASE("chord_bending: a chord stores half B kappa^2 at kappa0 and nowhere else", "[fabric]") {
  const double arm = GENERATE(1e-3, 5e-3, 0.02);
  CAPTURE(arm);
  for (const double kappa : {15.0, 30.0, 60.0}) {
    CAPTURE(kappa);
    Positions x = Positions::Zero(3, 2);
    x(0, 1) = 2 * arm * std::cos(kappa * arm / 2);
    const ChordBend bend = chord_bend(VertexId(0), VertexId(1), arm, kRigidity);
    CHECK(chord_energy({&bend, 1}, x) == Approx(stored(kRigidity, arm, kappa)).epsilon(1e-7));
  }
}

TEST_CASE("chord_bending: force is the energy's gradient, stiffness its second derivative",
          "[fabric]") {
  const double ratio = GENERATE(0.1, 0.5, 0.9, 0.999, 1.1);
  CAPTURE(ratio);
  const std::vector<ChordBend> bends = bend_between_two();
  const Positions x = vertices_at(ratio);
  const auto energy = [&](const Eigen::VectorXd& at) {
    return chord_energy(bends, at.reshaped(3, 2));
  };
  const auto force = [&](const Eigen::VectorXd& at) -> Eigen::VectorXd {
    return forces_of(bends, at.reshaped(3, 2)).reshaped();
  };
  const Eigen::VectorXd at = x.reshaped();
  const double step = difference_step(2 * kArm * std::abs(1 - ratio));  // the jump is that far
  const double scale = force(at).norm();
  CHECK((force(at) + difference_gradient(energy, at, step)).norm() <= 1e-6 * scale);
  const Mat3 B = chord_stiffness(bends[0], x, ElementHessian::exact);
  Eigen::MatrixXd K(6, 6);
  K << B, -B, -B, B;
  CHECK((K + difference_jacobian(force, at, step)).norm() <= 1e-6 * K.norm());
}

TEST_CASE("chord_bending: projected stiffness keeps the chord's and drops what is across",
          "[fabric]") {
  const double ratio = GENERATE(0.0, 0.01, 0.5, 0.999999, 1.0, 1.2);
  CAPTURE(ratio);
  const ChordBend bend = bend_between_two()[0];
  const Positions x = vertices_at(ratio);
  const Mat3 projected = chord_stiffness(bend, x, ElementHessian::projected);
  const Mat3 exact = chord_stiffness(bend, x, ElementHessian::exact);
  const Vec3 u = Vec3(2, -1, 2) / 3;
  CHECK(projected.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() >=
        -1e-15 * projected.norm());
  CHECK(u.dot(projected * u) == Approx(u.dot(exact * u)).epsilon(1e-9));
  CHECK((projected * u.unitOrthogonal()).norm() <= 1e-15 * projected.norm());
}

TEST_CASE("chord_bending: vertices in line or in one place stay finite", "[fabric]") {
  const ChordBend bend = bend_between_two()[0];
  Positions in_line = Positions::Zero(3, 2);
  in_line(0, 1) = 2 * kArm;
  CHECK(chord_energy({&bend, 1}, in_line) == 0);
  CHECK(forces_of({bend}, in_line).isZero(0));
  CHECK(chord_stiffness(bend, in_line, ElementHessian::exact).isZero(0));
  const Positions in_one_place = Positions::Zero(3, 2);
  CHECK(chord_energy({&bend, 1}, in_one_place) > 0);
  CHECK(forces_of({bend}, in_one_place).isZero(0));
  CHECK(chord_stiffness(bend, in_one_place, ElementHessian::exact).isZero(0));
}

TEST_CASE("chord_bending: a sheet rolled to a cylinder stores a chord's energy on all its area",
          "[fabric]") {
  const int cells = GENERATE(8, 16, 32, 64);
  const double turn = GENERATE(0.05, 0.2, 0.4);  // [rad] per edge
  CAPTURE(cells, turn);
  const FabricConstants fabric = library_fabric("wool");
  const QuadMesh mesh = sheet_with_aspect(cells, cells, 1.2);
  const std::vector<ChordBend> bends = spring_lattice(mesh, fabric, BendingLaw::linear).chord_bends;
  const double inner_area = 1.2 * (cells - 1) / cells;  // the border rows hold no element
  const auto expected = [&](double rigidity, double arm) {
    return stored(rigidity * inner_area / arm, arm, turn / arm);
  };
  CHECK(chord_energy(bends, rolled_along_warp(mesh, cells, turn)) ==
        Approx(expected(fabric.bend_warp, 1.2 / cells)).epsilon(1e-9));
  CHECK(chord_energy(bends, rolled_along_weft(mesh, cells, turn)) ==
        Approx(expected(fabric.bend_weft, 1.0 / cells)).epsilon(1e-9));
}

TEST_CASE("chord_bending: a lattice bends by the law that is asked for alone", "[fabric]") {
  const QuadMesh mesh = square_sheet(5);
  const FabricConstants fabric = library_fabric("wool");
  const auto [law, n_bends, n_chords] = GENERATE(table<BendingLaw, std::size_t, std::size_t>(
      {{BendingLaw::none, 0, 0}, {BendingLaw::quadratic, 48, 0}, {BendingLaw::linear, 0, 48}}));
  CAPTURE(law);
  const SpringLattice lattice = spring_lattice(mesh, fabric, law);
  CHECK(lattice.bends.size() == n_bends);
  CHECK(lattice.chord_bends.size() == n_chords);
  CHECK(lattice.springs.size() == spring_lattice(mesh, fabric).springs.size());
}

TEST_CASE("chord_bending: an arm without length and a negative rigidity are refused", "[fabric]") {
  CHECK_THROWS_AS(chord_bend(VertexId(0), VertexId(1), 0, 1), ContractError);
  CHECK_THROWS_AS(chord_bend(VertexId(0), VertexId(1), 1, -1), ContractError);
}

}  // namespace pleat
