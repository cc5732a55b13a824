#include "core/linalg/linear_solver.h"

#include <Eigen/Dense>
#include <array>
#include <catch2/catch.hpp>
#include <limits>

#include "core/base/check.h"
#include "core/linalg/make_linear_solver.h"
#include "native-tests/support/allocation_count.h"
#include "native-tests/support/finite_difference.h"
#include "native-tests/support/linear_systems.h"

namespace pleat {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A native build has all of them: making one that it lacks throws.
constexpr std::array kKinds = {SolverKind::cholmod, SolverKind::supernodal, SolverKind::eigen,
                               SolverKind::cg, SolverKind::sor};

SolverOptions tight() { return {1e-12, 10000}; }

MatrixXd solution_of(SolverKind kind, const SparseMatrix& lower, const MatrixXd& rhs) {
  const auto solver = make_linear_solver(kind, tight());
  solver->analyze(lower);
  REQUIRE(solver->factorize(lower).ok());
  MatrixXd solution = MatrixXd::Zero(rhs.rows(), rhs.cols());
  REQUIRE(solver->solve(rhs, solution).ok());
  return solution;
}

}  // namespace

TEST_CASE("linalg: every solver gives the answer of a dense factorisation", "[linalg]") {
  const int side = GENERATE(1, 2, 5, 9);
  const int columns = GENERATE(1, 3, 6);
  const bool grid = GENERATE(true, false);
  CAPTURE(side, columns, grid);
  const SparseMatrix lower = grid ? grid_system(side, 11) : random_system(side * side, 12);
  Random random(13);
  const MatrixXd rhs = random_columns(lower.rows(), columns, random);
  const MatrixXd expected = full_of(lower).ldlt().solve(rhs);
  for (const SolverKind kind : kKinds) {
    CAPTURE(name(kind));
    // The systems' condition numbers stay below 1e4, the residuals below 1e-12.
    CHECK(relative_error(solution_of(kind, lower, rhs), expected) < 1e-8);
  }
}

TEST_CASE("linalg: the direct solvers agree to rounding", "[linalg]") {
  const std::uint64_t seed = GENERATE(1, 2, 3);
  const SparseMatrix lower = grid_system(12, seed);
  Random random(seed);
  const MatrixXd rhs = random_columns(lower.rows(), 3, random);
  CHECK(relative_error(solution_of(SolverKind::cholmod, lower, rhs),
                       solution_of(SolverKind::eigen, lower, rhs)) < 1e-12);
}

// Second differences are exact on parabolas: -u'' = 1, u(0) = u(1) = 0 gives u = x (1 - x) / 2 at
// the nodes.
TEST_CASE("linalg: the loaded string has its parabola", "[linalg]") {
  const int n = GENERATE(3, 30, 99);
  CAPTURE(n);
  const double spacing = 1.0 / (n + 1);
  MatrixXd A = MatrixXd::Zero(n, n);
  A.diagonal().setConstant(2);
  A.diagonal(1).setConstant(-1);
  A.diagonal(-1).setConstant(-1);
  VectorXd exact(n);
  for (int k = 0; k < n; ++k) exact[k] = 0.5 * (k + 1) * spacing * (1 - (k + 1) * spacing);
  const VectorXd load = VectorXd::Constant(n, spacing * spacing);
  for (const SolverKind kind : kKinds) {
    CAPTURE(name(kind));
    // Condition number 4 (n + 1)^2 / pi^2, at most 4e3.
    CHECK(relative_error(solution_of(kind, lower_of(A), load), exact) < 1e-9);
  }
}

TEST_CASE("linalg: an indefinite matrix is reported, not solved", "[linalg]") {
  MatrixXd A = MatrixXd::Identity(6, 6);
  A(4, 4) = -1;
  for (const SolverKind kind : kKinds) {
    CAPTURE(name(kind));
    const auto solver = make_linear_solver(kind);
    solver->analyze(lower_of(A));
    const SolveReport report = solver->factorize(lower_of(A));
    CHECK(report.status == SolveStatus::not_positive_definite);
    CHECK_FALSE(report.message.empty());
    MatrixXd x = MatrixXd::Zero(6, 1);
    CHECK_THROWS_AS(solver->solve(MatrixXd::Ones(6, 1), x), ContractError);
  }
}

TEST_CASE("linalg: cholmod names the row of the pivot that is not positive", "[linalg]") {
  MatrixXd A = full_of(grid_system(4, 5));
  A(9, 9) = -500;
  const auto solver = make_linear_solver(SolverKind::cholmod);
  solver->analyze(lower_of(A));
  CHECK(solver->factorize(lower_of(A)).message == "pivot of row 9 is not positive");
}

TEST_CASE("linalg: a factorisation that failed can be followed by one that works", "[linalg]") {
  const SparseMatrix good = grid_system(4, 2);
  SparseMatrix bad = good;
  bad.coeffRef(0, 0) = -1;
  Random random(1);
  const MatrixXd rhs = random_columns(good.rows(), 1, random);
  for (const SolverKind kind : kKinds) {
    CAPTURE(name(kind));
    const auto solver = make_linear_solver(kind, tight());
    solver->analyze(good);
    REQUIRE_FALSE(solver->factorize(bad).ok());
    REQUIRE(solver->factorize(good).ok());
    MatrixXd x = MatrixXd::Zero(rhs.rows(), 1);
    REQUIRE(solver->solve(rhs, x).ok());
    CHECK(relative_error(full_of(good) * x, rhs) < 1e-11);
  }
}

TEST_CASE("linalg: no load, no answer but zero, whatever the start", "[linalg]") {
  const SparseMatrix lower = grid_system(4, 9);
  for (const SolverKind kind : kKinds) {
    CAPTURE(name(kind));
    const auto solver = make_linear_solver(kind);
    solver->analyze(lower);
    REQUIRE(solver->factorize(lower).ok());
    MatrixXd x = MatrixXd::Ones(lower.rows(), 2);
    CHECK(solver->solve(MatrixXd::Zero(lower.rows(), 2), x).ok());
    CHECK(x.isZero(0));
  }
}

TEST_CASE("linalg: a value that is not finite is reported with its place", "[linalg]") {
  const double bad =
      GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  const SparseMatrix lower = grid_system(4, 9);
  SparseMatrix broken = lower;
  broken.coeffRef(5, 3) = bad;
  MatrixXd rhs = MatrixXd::Ones(lower.rows(), 2);
  rhs(7, 1) = bad;
  for (const SolverKind kind : kKinds) {
    CAPTURE(name(kind), bad);
    const auto solver = make_linear_solver(kind);
    solver->analyze(lower);
    const SolveReport factorize_report = solver->factorize(broken);
    CHECK(factorize_report.status == SolveStatus::not_finite);
    CHECK(factorize_report.message == "matrix entry (5, 3) is not finite");
    REQUIRE(solver->factorize(lower).ok());
    MatrixXd x = MatrixXd::Zero(lower.rows(), 2);
    const SolveReport solve_report = solver->solve(rhs, x);
    CHECK(solve_report.status == SolveStatus::not_finite);
    CHECK(solve_report.message == "right-hand side (7, 1) is not finite");
  }
}

TEST_CASE("linalg: new values replace the old ones", "[linalg]") {
  const SparseMatrix first = grid_system(5, 1);
  const SparseMatrix second = 7 * first;
  Random random(2);
  const MatrixXd rhs = random_columns(first.rows(), 1, random);
  for (const SolverKind kind : kKinds) {
    CAPTURE(name(kind));
    const auto solver = make_linear_solver(kind, tight());
    solver->analyze(first);
    MatrixXd x = MatrixXd::Zero(rhs.rows(), 1);
    REQUIRE(solver->factorize(first).ok());
    REQUIRE(solver->solve(rhs, x).ok());
    REQUIRE(solver->factorize(second).ok());
    REQUIRE(solver->solve(rhs, x).ok());
    CHECK(relative_error(7 * (full_of(first) * x), rhs) < 1e-11);
  }
}

TEST_CASE("linalg: the scale of a system does not matter", "[linalg]") {
  const double scale = GENERATE(1e-8, 1e8);
  const SparseMatrix lower = grid_system(6, 1);
  Random random(2);
  const MatrixXd rhs = random_columns(lower.rows(), 1, random);
  for (const SolverKind kind : kKinds) {
    CAPTURE(name(kind), scale);
    const MatrixXd expected = solution_of(kind, lower, rhs);
    CHECK(relative_error(scale * solution_of(kind, scale * lower, rhs), expected) < 1e-9);
    CHECK(relative_error(solution_of(kind, lower, scale * rhs) / scale, expected) < 1e-9);
  }
}

TEST_CASE("linalg: a column of a larger array is solved in place", "[linalg]") {
  const SparseMatrix lower = grid_system(4, 1);
  Random random(2);
  const MatrixXd rhs = random_columns(lower.rows() + 2, 3, random);
  for (const SolverKind kind : kKinds) {
    CAPTURE(name(kind));
    const auto solver = make_linear_solver(kind, tight());
    solver->analyze(lower);
    REQUIRE(solver->factorize(lower).ok());
    MatrixXd x = MatrixXd::Zero(rhs.rows(), 3);
    REQUIRE(solver->solve(rhs.topRows(lower.rows()), x.topRows(lower.rows())).ok());
    CHECK(relative_error(full_of(lower) * x.topRows(lower.rows()), rhs.topRows(lower.rows())) <
          1e-11);
    CHECK(x.bottomRows(2).isZero(0));
  }
}

TEST_CASE("linalg: a system without unknowns is solved", "[linalg]") {
  const SparseMatrix lower(0, 0);
  for (const SolverKind kind : kKinds) {
    CAPTURE(name(kind));
    const auto solver = make_linear_solver(kind);
    solver->analyze(lower);
    CHECK(solver->factorize(lower).ok());
    MatrixXd x(0, 1);
    CHECK(solver->solve(MatrixXd(0, 1), x).ok());
  }
}

TEST_CASE("linalg: calls out of order and sizes that disagree are our bug", "[linalg]") {
  const SparseMatrix lower = grid_system(3, 1);
  for (const SolverKind kind : kKinds) {
    CAPTURE(name(kind));
    const auto solver = make_linear_solver(kind);
    MatrixXd x = MatrixXd::Zero(lower.rows(), 1);
    const MatrixXd rhs = x;
    CHECK_THROWS_AS(solver->factorize(lower), ContractError);
    CHECK_THROWS_AS(solver->solve(rhs, x), ContractError);
    solver->analyze(lower);
    CHECK_THROWS_AS(solver->solve(rhs, x), ContractError);
    CHECK_THROWS_AS(solver->factorize(grid_system(4, 1)), ContractError);
    REQUIRE(solver->factorize(lower).ok());
    CHECK_THROWS_AS(solver->solve(rhs.topRows(3), x), ContractError);
    CHECK_THROWS_AS(solver->solve(rhs.topRows(3), x.topRows(3)), ContractError);
    solver->analyze(lower);
    CHECK_THROWS_AS(solver->solve(rhs, x), ContractError);
  }
}

TEST_CASE("linalg: no solve after a factorisation that failed", "[linalg]") {
  const SparseMatrix good = grid_system(3, 1);
  SparseMatrix bad = good;
  bad.coeffRef(0, 0) = -1;
  for (const SolverKind kind : kKinds) {
    CAPTURE(name(kind));
    const auto solver = make_linear_solver(kind);
    solver->analyze(good);
    REQUIRE(solver->factorize(good).ok());
    REQUIRE_FALSE(solver->factorize(bad).ok());
    MatrixXd x = MatrixXd::Zero(good.rows(), 1);
    CHECK_THROWS_AS(solver->solve(MatrixXd::Ones(good.rows(), 1), x), ContractError);
  }
}

TEST_CASE("linalg: another pattern needs another analyze", "[linalg]") {
  const SparseMatrix ring = grid_system(2, 1);
  const SparseMatrix diagonal = lower_of(MatrixXd::Identity(12, 12));
  for (const SolverKind kind : kKinds) {
    CAPTURE(name(kind));
    const auto solver = make_linear_solver(kind);
    solver->analyze(ring);
    CHECK_THROWS_AS(solver->factorize(diagonal), ContractError);
    solver->analyze(diagonal);
    CHECK(solver->factorize(diagonal).ok());
  }
}

TEST_CASE("linalg: an upper triangle or a missing diagonal is our bug", "[linalg]") {
  MatrixXd upper = MatrixXd::Identity(3, 3);
  upper(0, 2) = 1;
  MatrixXd hole = MatrixXd::Identity(3, 3);
  hole(1, 1) = 0;
  for (const SolverKind kind : kKinds) {
    CAPTURE(name(kind));
    const auto solver = make_linear_solver(kind);
    CHECK_THROWS_AS(solver->analyze(upper.sparseView()), ContractError);
    CHECK_THROWS_AS(solver->analyze(lower_of(hole)), ContractError);
    CHECK_THROWS_AS(solver->analyze(SparseMatrix(3, 4)), ContractError);
  }
}

TEST_CASE("linalg: options outside their range are our bug", "[linalg]") {
  CHECK_THROWS_AS((SolverOptions{0, 10}.validate()), ContractError);
  CHECK_THROWS_AS((SolverOptions{1, 10}.validate()), ContractError);
  CHECK_THROWS_AS((SolverOptions{std::numeric_limits<double>::quiet_NaN(), 10}.validate()),
                  ContractError);
  CHECK_THROWS_AS((SolverOptions{1e-3, 0}.validate()), ContractError);
  CHECK_THROWS_AS((SolverOptions{1e-3, 10, 2}.validate()), ContractError);
  CHECK_THROWS_AS((SolverOptions{1e-3, 10, -0.1}.validate()), ContractError);
  for (const SolverKind kind : {SolverKind::cg, SolverKind::sor}) {
    const auto solver = make_linear_solver(kind);
    CHECK_THROWS_AS(solver->analyze(lower_of(MatrixXd::Identity(4, 4))), ContractError);
  }
}

TEST_CASE("linalg: the same call gives the same bits", "[linalg]") {
  const SparseMatrix lower = grid_system(9, 1);
  Random random(2);
  const MatrixXd rhs = random_columns(lower.rows(), 3, random);
  for (const SolverKind kind : kKinds) {
    CAPTURE(name(kind));
    CHECK(solution_of(kind, lower, rhs) == solution_of(kind, lower, rhs));
  }
}

TEST_CASE("linalg: nothing is allocated again for the same pattern", "[linalg]") {
  if (!counts_allocations()) return;
  const SparseMatrix lower = grid_system(9, 1);
  Random random(2);
  const MatrixXd rhs = random_columns(lower.rows(), 3, random);
  MatrixXd x = MatrixXd::Zero(lower.rows(), 3);
  for (const SolverKind kind : kKinds) {
    CAPTURE(name(kind));
    const auto solver = make_linear_solver(kind);
    solver->analyze(lower);
    const auto factorize = [&] { return solver->factorize(lower).ok(); };
    const auto solve = [&] { return solver->solve(rhs, x).ok(); };
    REQUIRE((factorize() && solve() && factorize()));
    // The direct libraries permute the matrix in arrays of their own;
    // docs/methods/linear_solvers.md lists them.
    if (!is_direct(kind)) CHECK(allocations_in(factorize) == 0);
    CHECK(allocations_in(solve) == 0);
  }
}

}  // namespace pleat
