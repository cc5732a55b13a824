#include "core/reference/rigid_chain.h"

#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/base/random.h"
#include "native-tests/support/analytic.h"

using namespace pleat;

namespace {

constexpr double kGravity = 9.81;  // [m/s^2]

/// One metre of chain in n links, the last node with half the mass of the others.
RigidChain uniform_chain(int n) {
  std::vector<double> masses(static_cast<std::size_t>(n), 0.2 / n);
  masses.back() /= 2;
  return RigidChain(std::vector<double>(static_cast<std::size_t>(n), 1.0 / n), masses, kGravity);
}

/// Angular accelerations, from one Runge-Kutta step too short for the angles to change.
Eigen::VectorXd accelerations(RigidChain chain, const Eigen::VectorXd& angles,
                              const Eigen::VectorXd& rates) {
  constexpr double kInstant = 1e-6;  // [s]
  chain.place(angles, rates);
  chain.advance(kInstant, 1);
  return (chain.rates() - rates) / kInstant;
}

/// Accelerations from Lagrange's equations with the full mass matrix:
/// sum_j mu_ij l_i l_j (cos(a_i - a_j) a_j'' + sin(a_i - a_j) a_j'^2) = -mu_ii g l_i sin a_i,
/// mu_ij the mass beyond the farther of both links.
Eigen::VectorXd lagrange_accelerations(const std::vector<double>& lengths,
                                       const std::vector<double>& masses,
                                       const Eigen::VectorXd& angles,
                                       const Eigen::VectorXd& rates) {
  const auto n = static_cast<Eigen::Index>(lengths.size());
  const auto mass_beyond = [&](Eigen::Index i) {
    double sum = 0;
    for (auto k = static_cast<std::size_t>(i); k < masses.size(); ++k) sum += masses[k];
    return sum;
  };
  Eigen::MatrixXd M(n, n);
  Eigen::VectorXd f(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double l_i = lengths[static_cast<std::size_t>(i)];
    f[i] = -mass_beyond(i) * kGravity * l_i * std::sin(angles[i]);
    for (Eigen::Index j = 0; j < n; ++j) {
      const double mu = mass_beyond(std::max(i, j)) * l_i * lengths[static_cast<std::size_t>(j)];
      M(i, j) = mu * std::cos(angles[i] - angles[j]);
      f[i] -= mu * std::sin(angles[i] - angles[j]) * rates[j] * rates[j];
    }
  }
  return M.ldlt().solve(f);
}

Eigen::VectorXd random_vector(int n, double size, Random& random) {
  Eigen::VectorXd v(n);
  for (double& value : v) value = random.uniform(-size, size);
  return v;
}

/// Angular frequencies of small swings about straight down, ascending.
Eigen::VectorXd small_swing_frequencies(const RigidChain& chain, int n) {
  constexpr double kSmall = 1e-6;  // [rad]
  Eigen::MatrixXd A(n, n);
  for (int j = 0; j < n; ++j)
    A.col(j) =
        accelerations(chain, kSmall * Eigen::VectorXd::Unit(n, j), Eigen::VectorXd::Zero(n)) /
        kSmall;
  Eigen::VectorXd squares = -A.eigenvalues().real();
  std::sort(squares.begin(), squares.end());
  return squares.cwiseSqrt();
}

double energy_change(int n, int n_steps) {
  RigidChain chain = uniform_chain(n);
  chain.place(Eigen::VectorXd::Constant(n, kPi / 2), Eigen::VectorXd::Zero(n));
  const double before = chain.energy();
  chain.advance(0.6, n_steps);
  return std::abs(chain.energy() - before);
}

}  // namespace

TEST_CASE("rigid_chain: one link has the period of the rigid pendulum", "[reference]") {
  const double amplitude = GENERATE(0.1, 1.5707963267948966, 3.0);
  CAPTURE(amplitude);
  RigidChain chain({0.7}, {0.3}, kGravity);
  chain.place(Eigen::VectorXd::Constant(1, amplitude), Eigen::VectorXd::Zero(1));
  chain.advance(pendulum_period(0.7, kGravity, amplitude), 20000);
  CHECK(chain.angles()[0] == Approx(amplitude).epsilon(1e-9));
  CHECK(chain.rates()[0] == Approx(0).margin(1e-6));
}

TEST_CASE("rigid_chain: accelerations obey Lagrange's equations", "[reference]") {
  const int n = GENERATE(1, 2, 5);
  Random random(static_cast<std::uint64_t>(GENERATE(1, 2, 3)));
  CAPTURE(n);
  std::vector<double> lengths, masses;
  for (int i = 0; i < n; ++i) {
    lengths.push_back(random.uniform(0.1, 1));
    masses.push_back(random.uniform(0.1, 1));
  }
  const Eigen::VectorXd angles = random_vector(n, kPi, random);
  const Eigen::VectorXd rates = random_vector(n, 3, random);
  const RigidChain chain(lengths, masses, kGravity);
  const Eigen::VectorXd exact = lagrange_accelerations(lengths, masses, angles, rates);
  const Eigen::VectorXd found = accelerations(chain, angles, rates);
  // The step of 1e-6 s lets the accelerations themselves change by about that much.
  CHECK((found - exact).norm() < 1e-3 * (1 + exact.norm()));
}

TEST_CASE("rigid_chain: small swings converge to the Bessel frequencies", "[reference]") {
  const std::size_t mode = GENERATE(std::size_t{0}, std::size_t{1}, std::size_t{2});
  CAPTURE(mode);
  const double exact = hanging_chain_omega(1, kGravity, mode);
  std::vector<double> errors;
  for (const int n : {20, 40, 80})
    errors.push_back(std::abs(
        small_swing_frequencies(uniform_chain(n), n)[static_cast<Eigen::Index>(mode)] / exact - 1));
  CHECK(std::log2(errors[0] / errors[1]) == Approx(2).margin(0.2));
  CHECK(std::log2(errors[1] / errors[2]) == Approx(2).margin(0.2));
}

TEST_CASE("rigid_chain: energy is kept to the order of the integration", "[reference]") {
  const double coarse = energy_change(10, 2000);
  const double fine = energy_change(10, 4000);
  CHECK(fine < 1e-8 * 0.2 * kGravity);  // share of the energy of a fall by its length
  CHECK(std::log2(coarse / fine) > 3.5);
}

TEST_CASE("rigid_chain: a straight hanging chain stays", "[reference]") {
  RigidChain chain = uniform_chain(7);
  chain.advance(1, 100);
  CHECK(chain.angles().norm() == 0);
  CHECK(chain.positions().col(7).y() == Approx(-1).epsilon(1e-14));
}

TEST_CASE("rigid_chain: broken promises are refused", "[reference]") {
  CHECK_THROWS_AS(RigidChain({}, {}, kGravity), ContractError);
  CHECK_THROWS_AS(RigidChain({1}, {1, 1}, kGravity), ContractError);
  CHECK_THROWS_AS(RigidChain({0}, {1}, kGravity), ContractError);
  CHECK_THROWS_AS(RigidChain({1}, {-1}, kGravity), ContractError);
}
