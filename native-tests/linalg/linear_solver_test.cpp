#include "core/linalg/linear_solver.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/KroneckerProduct>
#include <vector>

#include "core/base/check.h"
#include "core/base/random.h"
#include "native-tests/support/allocation_count.h"
#include "native-tests/support/finite_difference.h"

namespace pleat {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

SparseMatrix lower_of(const MatrixXd& dense) {
  SparseMatrix lower = MatrixXd(dense.triangularView<Eigen::Lower>()).sparseView();
  lower.makeCompressed();
  return lower;
}

MatrixXd full_of(const SparseMatrix& lower) {
  return MatrixXd(lower).selfadjointView<Eigen::Lower>();
}

MatrixXd random_columns(Eigen::Index rows, Eigen::Index columns, Random& random) {
  MatrixXd result(rows, columns);
  for (Eigen::Index k = 0; k < result.size(); ++k) result.data()[k] = random.uniform(-1, 1);
  return result;
}

/// Five-point grid of side x side vertices with a random positive definite block on each edge and a
/// multiple of the identity on the diagonal: the shape of an implicit cloth step.
SparseMatrix grid_system(int side, int block_size, std::uint64_t seed) {
  Random random(seed);
  const int n = side * side;
  MatrixXd A = 0.1 * MatrixXd::Identity(n * block_size, n * block_size);
  const auto add_edge = [&](int a, int b) {
    const MatrixXd half = random_columns(block_size, block_size, random);
    const MatrixXd stiffness = half * half.transpose();
    A.block(a * block_size, a * block_size, block_size, block_size) += stiffness;
    A.block(b * block_size, b * block_size, block_size, block_size) += stiffness;
    A.block(a * block_size, b * block_size, block_size, block_size) -= stiffness;
    A.block(b * block_size, a * block_size, block_size, block_size) -= stiffness;
  };
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      if (column + 1 < side) add_edge(row * side + column, row * side + column + 1);
      if (row + 1 < side) add_edge(row * side + column, (row + 1) * side + column);
    }
  }
  return lower_of(A);
}

/// R R' + I with a third of the blocks of R present, none of them symmetric.
SparseMatrix random_system(int n_blocks, int block_size, std::uint64_t seed) {
  Random random(seed);
  const int n = n_blocks * block_size;
  MatrixXd R = MatrixXd::Zero(n, n);
  for (int row = 0; row < n_blocks; ++row) {
    for (int column = 0; column < n_blocks; ++column) {
      if (random.below(3) != 0) continue;
      R.block(row * block_size, column * block_size, block_size, block_size) =
          random_columns(block_size, block_size, random);
    }
  }
  return lower_of(R * R.transpose() + MatrixXd::Identity(n, n));
}

std::vector<SolverKind> available_kinds() {
  std::vector<SolverKind> kinds;
  for (const SolverKind kind : {SolverKind::cholmod, SolverKind::eigen, SolverKind::cg}) {
    if (is_available(kind)) kinds.push_back(kind);
  }
  return kinds;
}

SolverOptions tight() { return {1e-12, 10000}; }

MatrixXd solution_of(SolverKind kind, int block_size, const SparseMatrix& lower,
                     const MatrixXd& rhs) {
  const auto solver = make_linear_solver(kind, block_size, tight());
  solver->analyze(lower);
  REQUIRE(solver->factorize(lower).ok());
  MatrixXd solution = MatrixXd::Zero(rhs.rows(), rhs.cols());
  REQUIRE(solver->solve(rhs, solution).ok());
  return solution;
}

}  // namespace

TEST_CASE("linalg: every solver gives the answer of a dense factorisation", "[linalg]") {
  const int block_size = GENERATE(1, 3);
  const int side = GENERATE(1, 2, 5, 9);
  const int columns = GENERATE(1, 3);
  const bool grid = GENERATE(true, false);
  CAPTURE(block_size, side, columns, grid);
  const SparseMatrix lower =
      grid ? grid_system(side, block_size, 11) : random_system(side * side, block_size, 12);
  Random random(13);
  const MatrixXd rhs = random_columns(lower.rows(), columns, random);
  const MatrixXd expected = full_of(lower).ldlt().solve(rhs);
  for (const SolverKind kind : available_kinds()) {
    CAPTURE(name(kind));
    // The systems' condition numbers stay below 1e4, the residuals below 1e-12.
    CHECK(relative_error(solution_of(kind, block_size, lower, rhs), expected) < 1e-8);
  }
}

TEST_CASE("linalg: the direct solvers agree to rounding", "[linalg]") {
  if (!is_available(SolverKind::cholmod)) return;
  const int block_size = GENERATE(1, 3);
  const std::uint64_t seed = GENERATE(1, 2, 3);
  const SparseMatrix lower = grid_system(12, block_size, seed);
  Random random(seed);
  const MatrixXd rhs = random_columns(lower.rows(), 3, random);
  CHECK(relative_error(solution_of(SolverKind::cholmod, block_size, lower, rhs),
                       solution_of(SolverKind::eigen, block_size, lower, rhs)) < 1e-12);
}

// Second differences are exact on parabolas: -u'' = 1, u(0) = u(1) = 0 gives u = x (1 - x) / 2 at
// the nodes.
TEST_CASE("linalg: the loaded string has its parabola", "[linalg]") {
  const int n = GENERATE(3, 30, 300);
  const int block_size = GENERATE(1, 3);
  CAPTURE(n, block_size);
  const double spacing = 1.0 / (n + 1);
  MatrixXd A = MatrixXd::Zero(n, n);
  A.diagonal().setConstant(2);
  A.diagonal(1).setConstant(-1);
  A.diagonal(-1).setConstant(-1);
  VectorXd exact(n);
  for (int k = 0; k < n; ++k) exact[k] = 0.5 * (k + 1) * spacing * (1 - (k + 1) * spacing);
  const VectorXd load = VectorXd::Constant(n, spacing * spacing);
  for (const SolverKind kind : available_kinds()) {
    CAPTURE(name(kind));
    // Condition number 4 (n + 1)^2 / pi^2, at most 4e4.
    CHECK(relative_error(solution_of(kind, block_size, lower_of(A), load), exact) < 1e-9);
  }
}

TEST_CASE("linalg: an indefinite matrix is reported, not solved", "[linalg]") {
  const int block_size = GENERATE(1, 3);
  MatrixXd A = MatrixXd::Identity(6, 6);
  A(4, 4) = -1;
  for (const SolverKind kind : available_kinds()) {
    CAPTURE(name(kind), block_size);
    const auto solver = make_linear_solver(kind, block_size);
    solver->analyze(lower_of(A));
    const SolveReport report = solver->factorize(lower_of(A));
    CHECK(report.status == SolveStatus::not_positive_definite);
    CHECK_FALSE(report.message.empty());
    MatrixXd x = MatrixXd::Zero(6, 1);
    CHECK_THROWS_AS(solver->solve(MatrixXd::Ones(6, 1), x), ContractError);
  }
}

TEST_CASE("linalg: cholmod names the row of the pivot that is not positive", "[linalg]") {
  if (!is_available(SolverKind::cholmod)) return;
  MatrixXd A = full_of(grid_system(4, 1, 5));
  A(9, 9) = -50;
  const auto solver = make_linear_solver(SolverKind::cholmod, 1);
  solver->analyze(lower_of(A));
  CHECK(solver->factorize(lower_of(A)).message == "pivot of row 9 is not positive");
}

TEST_CASE("linalg: cg notices an indefinite matrix whose diagonal is positive", "[linalg]") {
  MatrixXd A(2, 2);
  A << 1, 2, 2, 1;
  const auto solver = make_linear_solver(SolverKind::cg, 1);
  solver->analyze(lower_of(A));
  REQUIRE(solver->factorize(lower_of(A)).ok());
  MatrixXd rhs(2, 1);
  rhs << 1, -1;
  MatrixXd x = MatrixXd::Zero(2, 1);
  CHECK(solver->solve(rhs, x).status == SolveStatus::not_positive_definite);
}

TEST_CASE("linalg: a factorisation that failed can be followed by one that works", "[linalg]") {
  const SparseMatrix good = grid_system(4, 3, 2);
  SparseMatrix bad = good;
  bad.coeffRef(0, 0) = -1;
  Random random(1);
  const MatrixXd rhs = random_columns(good.rows(), 1, random);
  for (const SolverKind kind : available_kinds()) {
    CAPTURE(name(kind));
    const auto solver = make_linear_solver(kind, 3, tight());
    solver->analyze(good);
    REQUIRE_FALSE(solver->factorize(bad).ok());
    REQUIRE(solver->factorize(good).ok());
    MatrixXd x = MatrixXd::Zero(rhs.rows(), 1);
    REQUIRE(solver->solve(rhs, x).ok());
    CHECK(relative_error(full_of(good) * x, rhs) < 1e-11);
  }
}

TEST_CASE("linalg: cg reports its cap and the residual it stopped at", "[linalg]") {
  const SparseMatrix lower = grid_system(9, 3, 4);
  const auto solver = make_linear_solver(SolverKind::cg, 3, {1e-9, 5});
  solver->analyze(lower);
  REQUIRE(solver->factorize(lower).ok());
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

TEST_CASE("linalg: cg keeps its promise about the residual", "[linalg]") {
  const double tolerance = GENERATE(1e-1, 1e-3, 1e-6, 1e-10, 1e-13);
  const int block_size = GENERATE(1, 3);
  CAPTURE(tolerance, block_size);
  const SparseMatrix lower = grid_system(12, block_size, 6);
  const auto solver = make_linear_solver(SolverKind::cg, block_size, {tolerance, 10000});
  solver->analyze(lower);
  REQUIRE(solver->factorize(lower).ok());
  Random random(8);
  const MatrixXd rhs = random_columns(lower.rows(), 1, random);
  MatrixXd x = MatrixXd::Zero(lower.rows(), 1);
  REQUIRE(solver->solve(rhs, x).ok());
  // 1 % for the rounding of this check's own product at 1e-13.
  CHECK(relative_error(full_of(lower) * x, rhs) < 1.01 * tolerance);
}

TEST_CASE("linalg: cg says so when rounding keeps it from its tolerance", "[linalg]") {
  MatrixXd A = full_of(grid_system(12, 3, 6));
  A.diagonal().array() +=
      1e-9 - 0.1;  // nearly singular: the residual stalls near epsilon |A| |x| / |b|
  const auto solver = make_linear_solver(SolverKind::cg, 3, {1e-14, 100000});
  const SparseMatrix lower = lower_of(A);
  solver->analyze(lower);
  REQUIRE(solver->factorize(lower).ok());
  const MatrixXd rhs = MatrixXd::Ones(lower.rows(), 1);
  MatrixXd x = MatrixXd::Zero(lower.rows(), 1);
  const SolveReport report = solver->solve(rhs, x);
  CHECK(report.status == SolveStatus::not_converged);
  CHECK(report.iterations < 100000);
  CHECK(report.relative_residual > 1e-14);
}

TEST_CASE("linalg: cg started at the solution takes no iteration", "[linalg]") {
  const SparseMatrix lower = grid_system(6, 3, 9);
  Random random(2);
  const MatrixXd exact = random_columns(lower.rows(), 3, random);
  const auto solver = make_linear_solver(SolverKind::cg, 3);
  solver->analyze(lower);
  REQUIRE(solver->factorize(lower).ok());
  MatrixXd x = exact;
  const SolveReport report = solver->solve(full_of(lower) * exact, x);
  CHECK(report.ok());
  CHECK(report.iterations == 0);
  CHECK(x == exact);
}

// Conjugate gradients end after as many steps as the preconditioned matrix has distinct
// eigenvalues.
TEST_CASE("linalg: cg ends after two steps on a complete graph", "[linalg]") {
  const int n = GENERATE(6, 60);
  const int block_size = GENERATE(1, 3);
  const MatrixXd A = (n + 1) * MatrixXd::Identity(n, n) - MatrixXd::Ones(n, n);
  const MatrixXd blocks = Eigen::kroneckerProduct(A, MatrixXd::Identity(block_size, block_size));
  Random random(5);
  const MatrixXd rhs = random_columns(blocks.rows(), 1, random);
  const auto solver = make_linear_solver(SolverKind::cg, block_size, {1e-7, 50});
  solver->analyze(lower_of(blocks));
  REQUIRE(solver->factorize(lower_of(blocks)).ok());
  MatrixXd x = MatrixXd::Zero(blocks.rows(), 1);
  CHECK(solver->solve(rhs, x).iterations == 2);
}

TEST_CASE("linalg: cg solves a block diagonal matrix in one step", "[linalg]") {
  Random random(21);
  MatrixXd A = MatrixXd::Zero(15, 15);
  for (int row = 0; row < 15; row += 3) {
    const MatrixXd half = random_columns(3, 3, random);
    A.block(row, row, 3, 3) = half * half.transpose() + 0.01 * MatrixXd::Identity(3, 3);
  }
  const auto solver = make_linear_solver(SolverKind::cg, 3, {1e-7, 50});
  solver->analyze(lower_of(A));
  REQUIRE(solver->factorize(lower_of(A)).ok());
  MatrixXd x = MatrixXd::Zero(15, 1);
  CHECK(solver->solve(random_columns(15, 1, random), x).iterations == 1);
}

TEST_CASE("linalg: no load, no answer but zero, whatever the start", "[linalg]") {
  const SparseMatrix lower = grid_system(4, 3, 9);
  for (const SolverKind kind : available_kinds()) {
    CAPTURE(name(kind));
    const auto solver = make_linear_solver(kind, 3);
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
  const SparseMatrix lower = grid_system(4, 3, 9);
  SparseMatrix broken = lower;
  broken.coeffRef(5, 3) = bad;
  MatrixXd rhs = MatrixXd::Ones(lower.rows(), 2);
  rhs(7, 1) = bad;
  for (const SolverKind kind : available_kinds()) {
    CAPTURE(name(kind), bad);
    const auto solver = make_linear_solver(kind, 3);
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

TEST_CASE("linalg: cg reports a start that is not finite", "[linalg]") {
  const SparseMatrix lower = grid_system(4, 3, 9);
  const auto solver = make_linear_solver(SolverKind::cg, 3);
  solver->analyze(lower);
  REQUIRE(solver->factorize(lower).ok());
  MatrixXd x = MatrixXd::Zero(lower.rows(), 1);
  x(2, 0) = kNaN;
  CHECK(solver->solve(MatrixXd::Ones(lower.rows(), 1), x).message ==
        "starting guess (2, 0) is not finite");
}

TEST_CASE("linalg: new values replace the old ones", "[linalg]") {
  const SparseMatrix first = grid_system(5, 3, 1);
  const SparseMatrix second = 7 * first;
  Random random(2);
  const MatrixXd rhs = random_columns(first.rows(), 1, random);
  for (const SolverKind kind : available_kinds()) {
    CAPTURE(name(kind));
    const auto solver = make_linear_solver(kind, 3, tight());
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
  const SparseMatrix lower = grid_system(6, 3, 1);
  Random random(2);
  const MatrixXd rhs = random_columns(lower.rows(), 1, random);
  for (const SolverKind kind : available_kinds()) {
    CAPTURE(name(kind), scale);
    const MatrixXd expected = solution_of(kind, 3, lower, rhs);
    CHECK(relative_error(scale * solution_of(kind, 3, scale * lower, rhs), expected) < 1e-9);
    CHECK(relative_error(solution_of(kind, 3, lower, scale * rhs) / scale, expected) < 1e-9);
  }
}

TEST_CASE("linalg: a column of a larger array is solved in place", "[linalg]") {
  const SparseMatrix lower = grid_system(4, 3, 1);
  Random random(2);
  const MatrixXd rhs = random_columns(lower.rows() + 2, 3, random);
  for (const SolverKind kind : available_kinds()) {
    CAPTURE(name(kind));
    const auto solver = make_linear_solver(kind, 3, tight());
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
  for (const SolverKind kind : available_kinds()) {
    CAPTURE(name(kind));
    const auto solver = make_linear_solver(kind, 3);
    solver->analyze(lower);
    CHECK(solver->factorize(lower).ok());
    MatrixXd x(0, 1);
    CHECK(solver->solve(MatrixXd(0, 1), x).ok());
  }
}

TEST_CASE("linalg: calls out of order and sizes that disagree are our bug", "[linalg]") {
  const SparseMatrix lower = grid_system(3, 3, 1);
  for (const SolverKind kind : available_kinds()) {
    CAPTURE(name(kind));
    const auto solver = make_linear_solver(kind, 3);
    MatrixXd x = MatrixXd::Zero(lower.rows(), 1);
    const MatrixXd rhs = x;
    CHECK_THROWS_AS(solver->factorize(lower), ContractError);
    CHECK_THROWS_AS(solver->solve(rhs, x), ContractError);
    solver->analyze(lower);
    CHECK_THROWS_AS(solver->solve(rhs, x), ContractError);
    CHECK_THROWS_AS(solver->factorize(grid_system(4, 3, 1)), ContractError);
    REQUIRE(solver->factorize(lower).ok());
    CHECK_THROWS_AS(solver->solve(rhs.topRows(3), x), ContractError);
    CHECK_THROWS_AS(solver->solve(rhs.topRows(3), x.topRows(3)), ContractError);
    solver->analyze(lower);
    CHECK_THROWS_AS(solver->solve(rhs, x), ContractError);
  }
}

TEST_CASE("linalg: an upper triangle or a missing diagonal is our bug", "[linalg]") {
  MatrixXd upper = MatrixXd::Identity(3, 3);
  upper(0, 2) = 1;
  MatrixXd hole = MatrixXd::Identity(3, 3);
  hole(1, 1) = 0;
  for (const SolverKind kind : available_kinds()) {
    CAPTURE(name(kind));
    const auto solver = make_linear_solver(kind, 3);
    CHECK_THROWS_AS(solver->analyze(upper.sparseView()), ContractError);
    CHECK_THROWS_AS(solver->analyze(lower_of(hole)), ContractError);
    CHECK_THROWS_AS(solver->analyze(SparseMatrix(3, 4)), ContractError);
  }
}

TEST_CASE("linalg: options outside their range are our bug", "[linalg]") {
  CHECK_THROWS_AS((SolverOptions{0, 10}.validate()), ContractError);
  CHECK_THROWS_AS((SolverOptions{1, 10}.validate()), ContractError);
  CHECK_THROWS_AS((SolverOptions{kNaN, 10}.validate()), ContractError);
  CHECK_THROWS_AS((SolverOptions{1e-3, 0}.validate()), ContractError);
  CHECK_THROWS_AS(make_linear_solver(SolverKind::cg, 2), ContractError);
  const auto solver = make_linear_solver(SolverKind::cg, 3);
  CHECK_THROWS_AS(solver->analyze(lower_of(MatrixXd::Identity(4, 4))), ContractError);
}

TEST_CASE("linalg: the same call gives the same bits", "[linalg]") {
  const SparseMatrix lower = grid_system(9, 3, 1);
  Random random(2);
  const MatrixXd rhs = random_columns(lower.rows(), 3, random);
  for (const SolverKind kind : available_kinds()) {
    CAPTURE(name(kind));
    CHECK(solution_of(kind, 3, lower, rhs) == solution_of(kind, 3, lower, rhs));
  }
}

TEST_CASE("linalg: nothing is allocated again for the same pattern", "[linalg]") {
  if (!kCountsAllocations) {
    SUCCEED("not counted: the sanitizer has a malloc of its own");
    return;
  }
  const SparseMatrix lower = grid_system(9, 3, 1);
  Random random(2);
  const MatrixXd rhs = random_columns(lower.rows(), 3, random);
  MatrixXd x = MatrixXd::Zero(lower.rows(), 3);
  for (const SolverKind kind : available_kinds()) {
    CAPTURE(name(kind));
    const auto solver = make_linear_solver(kind, 3);
    solver->analyze(lower);
    const auto factorize = [&] { return solver->factorize(lower).ok(); };
    const auto solve = [&] { return solver->solve(rhs, x).ok(); };
    REQUIRE((factorize() && solve() && factorize()));
    // The direct libraries permute the matrix in arrays of their own;
    // docs/methods/linear_solvers.md lists them.
    if (kind == SolverKind::cg) CHECK(allocations_in(factorize) == 0);
    CHECK(allocations_in(solve) == 0);
  }
}

}  // namespace pleat
