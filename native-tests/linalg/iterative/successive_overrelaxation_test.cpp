#include "core/linalg/iterative/successive_overrelaxation.h"

#include <catch2/catch.hpp>

#include "core/base/random.h"
#include "native-tests/support/linear_systems.h"

using namespace pleat;

namespace {

/// A chain of springs along x, y and z with ends held: consistently ordered, its block Jacobi
/// radius cos(pi / (n + 1)) where nothing else is on the diagonal.
SparseMatrix chain(int n) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (int i = 0; i < n; ++i) {
    A.block<3, 3>(3 * i, 3 * i) = 2 * Eigen::Matrix3d::Identity();
    if (i > 0) A.block<3, 3>(3 * i, 3 * (i - 1)) = -Eigen::Matrix3d::Identity();
  }
  return lower_of(A);
}

SolveReport solved(const SparseMatrix& lower, const SolverOptions& options,
                   Eigen::MatrixXd& solution) {
  const auto solver = make_successive_overrelaxation(options);
  solver->analyze(lower);
  REQUIRE(solver->factorize(lower).ok());
  Random random(3);
  const Eigen::MatrixXd rhs = random_columns(lower.rows(), 1, random);
  solution = Eigen::MatrixXd::Zero(lower.rows(), 1);
  SolveReport report = solver->solve(rhs, solution);
  const Eigen::MatrixXd rest = rhs - full_of(lower) * solution;
  CHECK(report.relative_residual == Approx(rest.norm() / rhs.norm()).epsilon(1e-3));
  return report;
}

}  // namespace

TEST_CASE("sor: it tells the residual of what it returns", "[linalg]") {
  const double omega = GENERATE(0.5, 1.0, 1.5, 0.0);
  CAPTURE(omega);
  Eigen::MatrixXd solution;
  CHECK(solved(grid_system(6, 4), {1e-6, 1000, omega}, solution).ok());
  const SolveReport capped = solved(grid_system(6, 4), {1e-12, 2, omega}, solution);
  CHECK(capped.status == SolveStatus::not_converged);
  CHECK(capped.iterations == 2);
}

// Young: the best omega takes about the square root of the sweeps of Gauss and Seidel, and its own
// estimate comes near it.
TEST_CASE("sor: over-relaxation saves sweeps, the estimate most of them", "[linalg]") {
  const SparseMatrix lower = chain(60);
  Eigen::MatrixXd solution;
  const auto sweeps = [&](double omega) {
    const SolveReport report = solved(lower, {1e-6, 100000, omega}, solution);
    REQUIRE(report.ok());
    return report.iterations;
  };
  const double radius = std::cos(3.14159265 / 61);
  const int best = sweeps(2 / (1 + std::sqrt(1 - radius * radius)));
  CAPTURE(best, sweeps(0), sweeps(1));
  CHECK(15 * best < sweeps(1));
  CHECK(sweeps(0) < 1.3 * best);
}

TEST_CASE("sor: it starts from what it is given, if that is better than zero", "[linalg]") {
  const SparseMatrix lower = grid_system(6, 4);
  const auto solver = make_successive_overrelaxation({1e-8, 1000});
  solver->analyze(lower);
  REQUIRE(solver->factorize(lower).ok());
  Random random(3);
  const Eigen::MatrixXd rhs = random_columns(lower.rows(), 1, random);
  Eigen::MatrixXd solution = Eigen::MatrixXd::Zero(lower.rows(), 1);
  const int cold = solver->solve(rhs, solution).iterations;
  CHECK(cold > 1);
  CHECK(solver->solve(rhs, solution).iterations == 0);
  solution *= -1e6;
  // The last solve's residuals let it look at them a little sooner.
  CHECK(solver->solve(rhs, solution).iterations <= cold);
}
