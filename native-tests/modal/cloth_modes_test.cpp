#include "core/modal/cloth_modes.h"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/model/system_matrix.h"
#include "native-tests/support/analytic.h"
#include "native-tests/support/models.h"

using namespace pleat;

namespace {

/// A sheet of springs and bending held at its first two vertices.
struct HeldSheet {
  QuadMesh mesh = square_sheet(5);
  ClothModel model = sheet_model(mesh, soft_fabric());
  Positions positions = rest_state(mesh).positions;

  HeldSheet() {
    for (const int v : {0, 1}) model.pins.push_back({VertexId(v), positions.col(v), Motion{}});
    // Taut, so that nothing is free to fold.
    positions *= 1.02;
    for (Pin& pin : model.pins) pin.place = positions.col(pin.vertex);
  }
};

}  // namespace

TEST_CASE("cloth_modes: those of the assembled spring matrices, by a dense solver", "[modal]") {
  const HeldSheet sheet;
  const Eigen::MatrixXd stiffness =
      dense(stiffness_matrix(sheet.model, sheet.positions, ElementHessian::exact));
  const int n_free = static_cast<int>(stiffness.rows()) - 6;
  const Eigen::VectorXd masses =
      sheet.model.masses.replicate(1, 3).transpose().reshaped().tail(n_free);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> expected(
      stiffness.bottomRightCorner(n_free, n_free), Eigen::MatrixXd(masses.asDiagonal()));
  Modes modes;
  CHECK(cloth_modes(sheet.model, sheet.positions, {}, 10, modes).ok());
  REQUIRE(modes.size() == 10);
  CHECK(modes.n_rigid == 0);
  CHECK(modes.residuals.maxCoeff() < 1e-8);
  for (int m = 0; m < 10; ++m) {
    CAPTURE(m);
    CHECK(modes.stiffness[m] == Approx(expected.eigenvalues()[m]).epsilon(1e-8));
    CHECK(modes.shapes.col(m).head(6).isZero(0));
    // A shape is one of the dense ones, where no other has its frequency.
    const Eigen::VectorXd shares = (expected.eigenvectors().transpose() * masses.asDiagonal() *
                                    modes.shapes.col(m).tail(n_free))
                                       .cwiseAbs2();
    double of_its_frequency = 0;
    for (int k = 0; k < n_free; ++k)
      if (std::abs(expected.eigenvalues()[k] / modes.stiffness[m] - 1) < 1e-6)
        of_its_frequency += shares[k];
    CHECK(of_its_frequency == Approx(1).epsilon(1e-8));
  }
}

TEST_CASE("cloth_modes: a hanging chain swings at the zeros of J0", "[modal]") {
  Chain chain;
  chain.n_springs = 60;
  chain.length = 1.0 / chain.n_springs;
  chain.mass = 0.2 / chain.n_springs;
  chain.stiffness = 1e6;
  const ClothModel model = chain_model(chain);
  Modes modes;
  CHECK(cloth_modes(model, hanging_state(chain).positions, {}, 6, modes).ok());
  // Modes come in pairs to both sides.
  for (int m = 0; m < 6; ++m) {
    CAPTURE(m);
    CHECK(std::sqrt(modes.stiffness[m]) ==
          Approx(hanging_chain_omega(1, chain.gravity, static_cast<std::size_t>(m / 2)))
              .epsilon(0.01));
  }
}

// Standing on its pin, the chain falls: to first order its tension has turned its sign.
TEST_CASE("cloth_modes: what falls has a negative stiffness", "[modal]") {
  Chain chain;
  Positions standing = hanging_state(chain).positions;
  for (Eigen::Index v = 1; v < standing.cols(); ++v)
    standing.col(v) = Vec3(0, 0.99 * chain.length * static_cast<double>(v), 0);
  Modes modes;
  CHECK(cloth_modes(chain_model(chain), standing, {}, 4, modes).ok());
  CHECK(modes.stiffness[0] < 0);
  CHECK(modes.residuals.maxCoeff() < 1e-8);
}

TEST_CASE("cloth_modes: vertices that lie on something are held", "[modal]") {
  const HeldSheet sheet;
  Modes free, lying;
  CHECK(cloth_modes(sheet.model, sheet.positions, {}, 3, free).ok());
  CHECK(cloth_modes(sheet.model, sheet.positions, {VertexId(35)}, 3, lying).ok());
  CHECK(lying.stiffness[0] > 1.1 * free.stiffness[0]);
  CHECK(lying.shapes.middleRows<3>(105).isZero(0));
  CHECK(cloth_modes(sheet.model, sheet.positions, {}, 102, free).ok());
  CHECK(free.size() == 102);
  CHECK_THROWS_AS(cloth_modes(sheet.model, sheet.positions, {}, 103, free), InputError);
  CHECK_THROWS_AS(cloth_modes(sheet.model, sheet.positions, {}, 0, free), InputError);
}

TEST_CASE("motion_shares: a mode's own motion is all in it, a mixture in both", "[modal]") {
  const HeldSheet sheet;
  Modes modes;
  CHECK(cloth_modes(sheet.model, sheet.positions, {}, 4, modes).ok());
  const auto moved = [&](double first, double third) -> Positions {
    const Eigen::VectorXd way = first * modes.shapes.col(0) + third * modes.shapes.col(2);
    return sheet.positions + Eigen::Map<const Positions>(way.data(), 3, way.size() / 3);
  };
  const Eigen::VectorXd& masses = sheet.model.masses;
  const auto shares = [&](const std::vector<Positions>& frames) {
    return motion_shares(modes, masses, sheet.positions, frames);
  };
  CHECK(shares({moved(0.1, 0), moved(-0.2, 0)}).isApprox(Eigen::Vector4d::Ones(), 1e-9));
  CHECK(shares({moved(0.3, 0), moved(0, 0.4)}).isApprox(Eigen::Vector4d(0.36, 0.36, 1, 1), 1e-9));
  CHECK(shares({sheet.positions}).isZero(0));
  Positions aside = sheet.positions;
  aside.row(1).array() += 0.01;  // pins too, which no mode moves
  CHECK(shares({aside})[3] < 1);
}
