#include "core/linalg/iterative/conjugate_gradient.h"

#include <Eigen/Dense>
#include <array>
#include <catch2/catch.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "native-tests/support/finite_difference.h"
#include "native-tests/support/linear_systems.h"

namespace pleat {

using Eigen::MatrixXd;

namespace {

std::unique_ptr<LinearSolver> factored(const SparseMatrix& lower, const SolverOptions& options) {
  auto solver = make_conjugate_gradient(options);
  solver->analyze(lower);
  REQUIRE(solver->factorize(lower).ok());
  return solver;
}

}  // namespace

TEST_CASE("linalg: cg notices an indefinite matrix whose diagonal is positive", "[linalg]") {
  MatrixXd A = MatrixXd::Identity(6, 6);
  A(0, 3) = A(3, 0) = 2;
  const auto solver = factored(lower_of(A), {});
  MatrixXd rhs = MatrixXd::Zero(6, 1);
  rhs(0, 0) = 1;
  rhs(3, 0) = -1;
  MatrixXd x = MatrixXd::Zero(6, 1);
  CHECK(solver->solve(rhs, x).status == SolveStatus::not_positive_definite);
}

TEST_CASE("linalg: cg reports its cap and the residual it stopped at", "[linalg]") {
  const SparseMatrix lower = grid_system(9, 4);
  const auto solver = factored(lower, {1e-9, 5});
  Random random(3);
  const MatrixXd rhs = random_columns(lower.rows(), 1, random);
  MatrixXd x = MatrixXd::Zero(lower.rows(), 1);
  const SolveReport report = solver->solve(rhs, x);
  CHECK(report.status == SolveStatus::not_converged);
  CHECK(report.iterations == 5);
  const double residual = relative_error(full_of(lower) * x, rhs);
  CHECK(report.relative_residual == Approx(residual).epsilon(1e-6));
  CHECK(residual > 1e-9);
}

TEST_CASE("linalg: cg may meet its tolerance with its last iteration", "[linalg]") {
  const SparseMatrix lower = grid_system(9, 4);
  Random random(3);
  const MatrixXd rhs = random_columns(lower.rows(), 1, random);
  const auto solve = [&](int max_iterations) {
    const auto solver = factored(lower, {1e-3, max_iterations});
    MatrixXd x = MatrixXd::Zero(lower.rows(), 1);
    return solver->solve(rhs, x);
  };
  const int enough = solve(1000).iterations;
  REQUIRE(enough > 1);
  CHECK(solve(enough).ok());
  CHECK(solve(1).status == SolveStatus::not_converged);
}

TEST_CASE("linalg: cg keeps its promise about the residual", "[linalg]") {
  const double tolerance = GENERATE(1e-1, 1e-3, 1e-6, 1e-10, 1e-13);
  CAPTURE(tolerance);
  const SparseMatrix lower = grid_system(12, 6);
  const auto solver = factored(lower, {tolerance, 10000});
  Random random(8);
  const MatrixXd rhs = random_columns(lower.rows(), 1, random);
  MatrixXd x = MatrixXd::Zero(lower.rows(), 1);
  REQUIRE(solver->solve(rhs, x).ok());
  // 1 % for the rounding of this check's own product at 1e-13.
  CHECK(relative_error(full_of(lower) * x, rhs) < 1.01 * tolerance);
}

TEST_CASE("linalg: cg says so when rounding keeps it from its tolerance", "[linalg]") {
  MatrixXd A = full_of(grid_system(12, 6));
  A.diagonal().array() +=
      1e-9 - 0.1;  // nearly singular: the residual stalls near epsilon |A| |x| / |b|
  const SparseMatrix lower = lower_of(A);
  const auto solver = factored(lower, {1e-14, 100000});
  const MatrixXd rhs = MatrixXd::Ones(lower.rows(), 1);
  MatrixXd x = MatrixXd::Zero(lower.rows(), 1);
  const SolveReport report = solver->solve(rhs, x);
  CHECK(report.status == SolveStatus::not_converged);
  CHECK(report.iterations < 100000);
  CHECK(report.relative_residual > 1e-14);
}

TEST_CASE("linalg: cg started at the solution takes no iteration", "[linalg]") {
  const SparseMatrix lower = grid_system(6, 9);
  Random random(2);
  const MatrixXd exact = random_columns(lower.rows(), 3, random);
  const auto solver = factored(lower, {});
  MatrixXd x = exact;
  const SolveReport report = solver->solve(full_of(lower) * exact, x);
  CHECK(report.ok());
  CHECK(report.iterations == 0);
  CHECK(x == exact);
}

// In its order no row of a tree has more than one later neighbour, so nothing would fill in: the
// incomplete factor is the whole one.
TEST_CASE("linalg: cg solves a tree in one step", "[linalg]") {
  const int n = GENERATE(2, 7, 100);
  Random random(5);
  std::vector<std::array<int, 2>> edges;
  for (int vertex = 1; vertex < n; ++vertex)
    edges.push_back({vertex, static_cast<int>(random.below(vertex))});
  const SparseMatrix lower = graph_system(n, edges, 8);
  const auto solver = factored(lower, {1e-7, 50});
  MatrixXd x = MatrixXd::Zero(lower.rows(), 1);
  CHECK(solver->solve(random_columns(lower.rows(), 1, random), x).iterations == 1);
}

TEST_CASE("linalg: cg begins at zero when its start is worse", "[linalg]") {
  const SparseMatrix lower = grid_system(6, 9);
  Random random(2);
  const MatrixXd rhs = random_columns(lower.rows(), 1, random);
  const auto solver = factored(lower, {});
  MatrixXd from_zero = MatrixXd::Zero(lower.rows(), 1);
  MatrixXd from_far = 1e6 * random_columns(lower.rows(), 1, random);
  REQUIRE(solver->solve(rhs, from_zero).ok());
  REQUIRE(solver->solve(rhs, from_far).ok());
  CHECK(from_far == from_zero);
}

TEST_CASE("linalg: cg solves a block diagonal matrix in one step", "[linalg]") {
  Random random(21);
  MatrixXd A = MatrixXd::Zero(15, 15);
  for (int row = 0; row < 15; row += 3) {
    const MatrixXd half = random_columns(3, 3, random);
    A.block(row, row, 3, 3) = half * half.transpose() + 0.01 * MatrixXd::Identity(3, 3);
  }
  const auto solver = factored(lower_of(A), {1e-7, 50});
  MatrixXd x = MatrixXd::Zero(15, 1);
  CHECK(solver->solve(random_columns(15, 1, random), x).iterations == 1);
}

TEST_CASE("linalg: cg reports a start that is not finite", "[linalg]") {
  const SparseMatrix lower = grid_system(4, 9);
  const auto solver = factored(lower, {});
  MatrixXd x = MatrixXd::Zero(lower.rows(), 1);
  x(2, 0) = std::numeric_limits<double>::quiet_NaN();
  CHECK(solver->solve(MatrixXd::Ones(lower.rows(), 1), x).message ==
        "starting guess (2, 0) is not finite");
}

}  // namespace pleat
