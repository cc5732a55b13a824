#include "core/linalg/aggregation/multigrid.h"

#include <Eigen/Dense>
#include <array>
#include <catch2/catch.hpp>
#include <string>

#include "core/linalg/aggregation/aggregation.h"
#include "core/linalg/iterative/conjugate_gradient.h"
#include "native-tests/support/allocation_count.h"
#include "native-tests/support/finite_difference.h"
#include "native-tests/support/linear_systems.h"

namespace pleat {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A system of equations over vertices, and where they are.
struct Placed {
  SparseMatrix lower;
  VectorXd places;
};

void hold(MatrixXd& A, Index vertex) {
  A.middleRows(3 * vertex, 3).setZero();
  A.middleCols(3 * vertex, 3).setZero();
  A.block(3 * vertex, 3 * vertex, 3, 3).setIdentity();
}

struct SheetOptions {
  double mass = 1e-5;
  bool is_held = true;  ///< true when its first row is held
  double grading = 1;   ///< ratio of each row's width to that of the one before
};

/// A wavy sheet of side x side vertices with stiff springs along its edges and diagonals, under a
/// tension of a fiftieth, with little mass: what a step of cloth solves.
Placed sheet(int side, const SheetOptions& options = {}) {
  const auto number = [side](int r, int c) { return Index{r} * side + c; };
  VectorXd places(3 * side * side);
  double width = 1, x = 0;
  for (int r = 0; r < side; ++r, x += width, width *= options.grading)
    for (int c = 0; c < side; ++c)
      places.segment<3>(3 * number(r, c)) << x, c, std::sin(0.4 * x) + std::cos(0.3 * c);
  const Index n = places.size();
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<char> is_held(static_cast<std::size_t>(side * side), 0);
  for (int c = 0; c < side && options.is_held; ++c) is_held[static_cast<std::size_t>(c)] = 1;
  const auto add = [&](Index a, Index b, const Eigen::Matrix3d& K) {
    if (is_held[static_cast<std::size_t>(a)] || is_held[static_cast<std::size_t>(b)]) {
      if (a != b) return entries.emplace_back(3 * std::max(a, b), 3 * std::min(a, b), 0.0), void();
      return;
    }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (3 * a + i >= 3 * b + j) entries.emplace_back(3 * a + i, 3 * b + j, K(i, j));
  };
  for (Index v = 0; v < side * side; ++v)
    for (int k = 0; k < 3; ++k)
      entries.emplace_back(3 * v + k, 3 * v + k,
                           is_held[static_cast<std::size_t>(v)] ? 1 : options.mass);
  for (int r = 0; r < side; ++r) {
    for (int c = 0; c < side; ++c) {
      for (const auto& [dr, dc] :
           {std::array{0, 1}, std::array{1, 0}, std::array{1, 1}, std::array{1, -1}}) {
        if (r + dr >= side || c + dc < 0 || c + dc >= side) continue;
        const Index a = number(r, c);
        const Index b = number(r + dr, c + dc);
        const Eigen::Vector3d edge = places.segment<3>(3 * b) - places.segment<3>(3 * a);
        const Eigen::Vector3d along = edge.normalized();
        const Eigen::Matrix3d K = (along * along.transpose() + 0.02 * Eigen::Matrix3d::Identity()) /
                                  (options.grading == 1 ? 1 : edge.norm());
        add(a, a, K);
        add(b, b, K);
        add(b, a, -K);
      }
    }
  }
  SparseMatrix lower(n, n);
  lower.setFromTriplets(entries.begin(), entries.end());
  lower.makeCompressed();
  return {lower, places};
}

/// The cycle as a dense matrix in the order of the unknowns.
MatrixXd cycle_of(const SparseMatrix& lower, const VectorXd& places) {
  BlockMatrix A;
  A.analyze(lower);
  A.set_values(lower);
  Multigrid multigrid;
  multigrid.analyze(A);
  if (places.size() > 0) multigrid.set_places(A, places.data());
  multigrid.compute(A);
  const Index n = lower.rows();
  MatrixXd inverse(n, n);
  for (Index k = 0; k < n; ++k) {
    const VectorXd unit = VectorXd::Unit(n, k);
    VectorXd r(n);
    VectorXd z(n);
    A.gather(unit.data(), r.data());
    multigrid.apply(r.data(), 1, z.data());
    A.scatter(z.data(), inverse.col(k).data());
  }
  return inverse;
}

struct Spectrum {
  double least, most;
};

/// Spectrum of M^-1 A, once the cycle is known to be symmetric to single precision.
Spectrum spectrum_of(const MatrixXd& inverse, const MatrixXd& A) {
  CHECK((inverse - inverse.transpose()).norm() < 1e-3 * inverse.norm());
  const MatrixXd root = Eigen::LLT<MatrixXd>(A).matrixL();
  const MatrixXd image = root.transpose() * (inverse + inverse.transpose()) / 2 * root;
  const VectorXd values = Eigen::SelfAdjointEigenSolver<MatrixXd>(image).eigenvalues();
  return {values.minCoeff(), values.maxCoeff()};
}

/// Cholesky factors of a level's diagonal, in blocks.
template <int B>
MatrixXd roots_of(const BlockLevel<B>& level) {
  MatrixXd roots = MatrixXd::Zero(Index{B} * level.n_rows(), Index{B} * level.n_rows());
  for (int row = 0; row < level.n_rows(); ++row)
    for (int r = 0; r < B; ++r)
      for (int c = 0; c < B; ++c) roots(B * row + r, B * row + c) = level.root(row)[B * r + c];
  return roots;
}

/// A level of 3 x 3 blocks, its groups, and the coarse level that they make.
struct TwoLevels {
  BlockLevel<3> fine;
  BlockLevel<kRigid> coarse;
  Coarsening<3> coarsening;
  RigidMotions<3> motions;
  RigidMotions<kRigid> coarse_motions;
  BlockMatrix A;
  Aggregates groups;

  explicit TwoLevels(const Placed& system) {
    A.analyze(system.lower);
    A.set_values(system.lower);
    LowerPattern pattern;
    for (int row = 0; row < A.n_rows(); ++row) {
      for (int k = A.begin(row); k < A.begin(row + 1); ++k) pattern.columns.push_back(A.column(k));
      pattern.begins.push_back(A.begin(row + 1));
    }
    pattern.find_columns();
    groups = aggregate(pattern, 8);
    fine.set_pattern(pattern);
    for (int row = 0; row < A.n_rows(); ++row)
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
          fine.diagonal(row)[3 * r + c] =
              A.diagonal_block(row)[r < c ? c * (c + 1) / 2 + r : r * (r + 1) / 2 + c];
    for (int k = 0; k < A.begin(A.n_rows()); ++k) std::copy_n(A.block(k), 9, fine.lower(k));
    fine.scale();
    motions.places.resize(static_cast<std::size_t>(3 * A.n_rows()));
    A.gather(system.places.data(), motions.places.data());
    motions.motions.assign(static_cast<std::size_t>(18 * A.n_rows()), 0.0);
    for (int row = 0; row < A.n_rows(); ++row)
      for (int k = 0; k < 3; ++k) motions.motions[place((3 * row + k) * kRigid + k)] = 1;
    coarsening.analyze(fine, groups, coarse);
    coarsening.compute(fine, motions, coarse, coarse_motions);
  }

  MatrixXd full() const {
    const Index n = 3 * A.n_rows();
    MatrixXd dense(n, n);
    for (Index k = 0; k < n; ++k) {
      const VectorXd unit = VectorXd::Unit(n, k);
      A.multiply(unit.data(), dense.col(k).data());
    }
    return dense;
  }

  MatrixXd prolongation() const {
    MatrixXd P = MatrixXd::Zero(3 * A.n_rows(), kRigid * groups.count);
    for (int row = 0; row < A.n_rows(); ++row)
      for (int p = coarsening.begin(row); p < coarsening.begin(row + 1); ++p)
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < kRigid; ++c)
            P(3 * row + r, kRigid * coarsening.column(p) + c) = coarsening.block(p)[r * kRigid + c];
    return unscaled(P);
  }

  MatrixXd tentative() const {
    MatrixXd T = MatrixXd::Zero(3 * A.n_rows(), kRigid * groups.count);
    for (int row = 0; row < A.n_rows(); ++row)
      for (int r = 0; r < 3 && groups.of_node[place(row)] >= 0; ++r)
        for (int c = 0; c < kRigid; ++c)
          T(3 * row + r, kRigid * groups.of_node[place(row)] + c) =
              coarsening.tentative(row)[r * kRigid + c];
    return unscaled(T);
  }

  /// Takes scaled unknowns of the fine level to its own.
  MatrixXd unscaled(const MatrixXd& columns) const {
    return roots_of(fine).transpose().triangularView<Eigen::Upper>().solve(columns);
  }
};

int iterations_of(const Placed& system, Preconditioner preconditioner, double tolerance = 1e-6) {
  SolverOptions options;
  options.tolerance = tolerance;
  options.max_iterations = 5000;
  options.preconditioner = preconditioner;
  const auto solver = make_conjugate_gradient(options);
  solver->analyze(system.lower);
  solver->set_places(system.places);
  REQUIRE(solver->factorize(system.lower).ok());
  Random random(4);
  const MatrixXd rhs = random_columns(system.lower.rows(), 1, random);
  MatrixXd x = MatrixXd::Zero(rhs.rows(), 1);
  const SolveReport report = solver->solve(rhs, x);
  REQUIRE(report.ok());
  CHECK(relative_error(full_of(system.lower) * x, rhs) < 1.01 * tolerance);
  return report.iterations;
}

}  // namespace

TEST_CASE("multigrid: a cycle is symmetric and positive definite", "[linalg]") {
  const std::string kind =
      GENERATE("sheet", "held", "hanging", "rested on", "graded", "grid", "no places");
  CAPTURE(kind);
  Placed system = kind == "grid" ? Placed{grid_system(9, 3), {}} : sheet(12, {1e-3});
  if (kind == "graded") system = sheet(12, {1e-3, true, 0.6});
  MatrixXd A = full_of(system.lower);
  if (kind == "held")
    for (const Index vertex : {40, 41, 77, 143}) hold(A, vertex);
  if (kind == "hanging")
    for (Index vertex = 30; vertex < 144; vertex += 7) hold(A, vertex);
  if (kind == "rested on")
    for (Index vertex = 60; vertex < 90; ++vertex)
      A.block(3 * vertex, 3 * vertex, 3, 3) +=
          A.block(3 * vertex, 3 * vertex, 3, 3).trace() / 3 * MatrixXd::Identity(3, 3);
  if (kind == "no places") system.places.resize(0);
  const SparseMatrix lower = lower_of(A);
  const Spectrum spectrum = spectrum_of(cycle_of(lower, system.places), A);
  CHECK(spectrum.least > 0.01);
  CHECK(spectrum.most < 1.01);  // no symmetric cycle of Gauss-Seidel sweeps goes too far
}

TEST_CASE("multigrid: rows that are a million times as stiff as others leave it definite",
          "[linalg]") {
  // Each row a quarter as wide as the one before: single precision has the last word, judged by
  // each vertex.
  const Placed system = sheet(12, {1e-3, true, 0.25});
  const Spectrum spectrum =
      spectrum_of(cycle_of(system.lower, system.places), full_of(system.lower));
  CHECK(spectrum.least > 0);
  CHECK(spectrum.most < 1.1);
}

TEST_CASE("multigrid: the coarse matrix is P'A P", "[linalg]") {
  const TwoLevels levels(sheet(9));
  const MatrixXd P = levels.prolongation();
  MatrixXd expected = P.transpose() * levels.full() * P;
  for (Index k = 0; k < expected.rows(); ++k)
    if (expected(k, k) == 0) expected(k, k) = 1;
  MatrixXd found = MatrixXd::Zero(expected.rows(), expected.cols());
  const auto put = [&](int row, int column, const double* block) {
    for (int r = 0; r < kRigid; ++r)
      for (int c = 0; c < kRigid; ++c)
        found(kRigid * row + r, kRigid * column + c) =
            found(kRigid * column + c, kRigid * row + r) = block[kRigid * r + c];
  };
  const LowerPattern& pattern = levels.coarse.pattern();
  for (int row = 0; row < levels.groups.count; ++row) {
    put(row, row, levels.coarse.diagonal(row));
    for (int k = pattern.begins[place(row)]; k < pattern.begins[place(row) + 1]; ++k)
      put(row, pattern.columns[place(k)], levels.coarse.lower(k));
  }
  const MatrixXd roots = roots_of(levels.coarse);
  CHECK(relative_error(roots * found * roots.transpose(), expected) < 1e-12);
}

TEST_CASE("multigrid: rigid motions of a sheet that nothing holds are in its groups", "[linalg]") {
  // Held vertices have no part in the groups: rows that are not coupled stay zero.
  const Placed system = sheet(9);
  const TwoLevels levels(system);
  const MatrixXd T = levels.tentative();
  CHECK((T.transpose() * T - MatrixXd::Identity(T.cols(), T.cols())).norm() < 1e-9);
  std::vector<double> places(static_cast<std::size_t>(system.places.size()));
  levels.A.gather(system.places.data(), places.data());
  for (int motion = 0; motion < kRigid; ++motion) {
    CAPTURE(motion);
    VectorXd moved = VectorXd::Zero(T.rows());
    for (int row = 0; row < levels.A.n_rows(); ++row) {
      if (levels.coarsening.tentative(row)[0] == 0 && levels.coarsening.tentative(row)[7] == 0 &&
          levels.coarsening.tentative(row)[14] == 0)
        continue;
      const Eigen::Vector3d at(places[place(3 * row)], places[place(3 * row + 1)],
                               places[place(3 * row + 2)]);
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(motion % 3);
      moved.segment<3>(3 * row) = motion < 3 ? axis : Eigen::Vector3d(axis.cross(at));
    }
    CHECK((T * (T.transpose() * moved) - moved).norm() < 1e-9 * moved.norm());
  }
}

TEST_CASE("multigrid: iterations hardly grow with the mesh", "[linalg]") {
  const int coarse = iterations_of(sheet(12), Preconditioner::multigrid);
  const int fine = iterations_of(sheet(48), Preconditioner::multigrid);
  CHECK(fine <= 1.5 * coarse);
  CHECK(fine <= 30);
}

TEST_CASE("multigrid: places of the vertices save iterations", "[linalg]") {
  Placed system = sheet(30);
  const int with = iterations_of(system, Preconditioner::multigrid);
  system.places.resize(0);
  CHECK(with < iterations_of(system, Preconditioner::multigrid));
}

TEST_CASE("multigrid: pieces, a lone vertex and one block are solved", "[linalg]") {
  const MatrixXd piece = full_of(sheet(5, {1e-2}).lower);
  MatrixXd A = MatrixXd::Identity(2 * piece.rows() + 3, 2 * piece.rows() + 3);
  A.topLeftCorner(piece.rows(), piece.cols()) = piece;
  A.bottomRightCorner(piece.rows(), piece.cols()) = 7 * piece;
  CHECK(iterations_of({lower_of(A), {}}, Preconditioner::multigrid) < 40);
  CHECK(iterations_of({grid_system(1, 3), {}}, Preconditioner::multigrid) == 1);
}

TEST_CASE("multigrid: the automatic choice takes over where a factor is slow", "[linalg]") {
  const Placed system = sheet(40);
  const int alone = iterations_of(system, Preconditioner::incomplete_factor);
  REQUIRE(alone > 150);
  CHECK(iterations_of(system, Preconditioner::automatic) < 100);
}

TEST_CASE("multigrid: the automatic choice is the factor alone where that is fast", "[linalg]") {
  const Placed system = sheet(20, {10});
  const int alone = iterations_of(system, Preconditioner::incomplete_factor);
  REQUIRE(alone < 60);
  CHECK(iterations_of(system, Preconditioner::automatic) == alone);
}

TEST_CASE("multigrid: the automatic choice changes by habit, not by one slow solve", "[linalg]") {
  const Placed slow = sheet(40);
  const Placed fast = sheet(40, {10});
  const int alone = iterations_of(fast, Preconditioner::incomplete_factor);
  REQUIRE(alone < 60);
  const auto solver = make_conjugate_gradient({});
  solver->analyze(slow.lower);
  Random random(4);
  const MatrixXd rhs = random_columns(slow.lower.rows(), 1, random);
  const auto iterations = [&](const Placed& system) {
    solver->set_places(system.places);
    REQUIRE(solver->factorize(system.lower).ok());
    MatrixXd x = MatrixXd::Zero(rhs.rows(), 1);
    const SolveReport report = solver->solve(rhs, x);
    REQUIRE(report.ok());
    return report.iterations;
  };
  CHECK(iterations(slow) > 60);
  CHECK(iterations(fast) == alone);
  CHECK(iterations(slow) > 60);
  CHECK(iterations(slow) > 60);
  CHECK(iterations(slow) < 60);
}

TEST_CASE("multigrid: the same calls give the same bits", "[linalg]") {
  const Placed system = sheet(20);
  const auto cycle = [&] { return cycle_of(system.lower, system.places); };
  CHECK(cycle() == cycle());
}

TEST_CASE("multigrid: values of another matrix leave nothing behind", "[linalg]") {
  const Placed first = sheet(10);
  const Placed second = sheet(10, {3});
  BlockMatrix A;
  A.analyze(first.lower);
  Multigrid multigrid;
  multigrid.analyze(A);
  VectorXd z(first.lower.rows());
  const VectorXd r = VectorXd::Ones(z.size());
  const auto apply = [&](const Placed& system) {
    A.set_values(system.lower);
    multigrid.set_places(A, system.places.data());
    multigrid.compute(A);
    multigrid.apply(r.data(), r.norm(), z.data());
    return z;
  };
  const VectorXd expected = apply(second);
  apply(first);
  CHECK(apply(second) == expected);
}

TEST_CASE("multigrid: an indefinite matrix is reported", "[linalg]") {
  MatrixXd A = full_of(sheet(8, {1e-2}).lower);
  A(100, 100) = -1;
  SolverOptions options;
  options.preconditioner = Preconditioner::multigrid;
  const auto solver = make_conjugate_gradient(options);
  solver->analyze(lower_of(A));
  CHECK(solver->factorize(lower_of(A)).status == SolveStatus::not_positive_definite);
  A = full_of(sheet(8, {1e-2}).lower);
  A.block(99, 102, 3, 3) *= 3;
  A.block(102, 99, 3, 3) *= 3;
  solver->analyze(lower_of(A));
  REQUIRE(solver->factorize(lower_of(A)).ok());
  Random random(5);
  const MatrixXd rhs = random_columns(A.rows(), 1, random);
  MatrixXd x = MatrixXd::Zero(A.rows(), 1);
  CHECK(solver->solve(rhs, x).status == SolveStatus::not_positive_definite);
}

TEST_CASE("multigrid: where single precision loses the cycle, the factor goes on", "[linalg]") {
  // Rigid motions of a free sheet cost a millionth of a millionth of what stretches it.
  SheetOptions free;
  free.mass = 1e-12;
  free.is_held = false;
  const Placed system = sheet(30, free);
  Random random(6);
  const MatrixXd rhs = full_of(system.lower) * random_columns(system.lower.rows(), 1, random);
  SolverOptions options;
  const auto iterations_twice = [&](Preconditioner preconditioner) {
    options.preconditioner = preconditioner;
    const auto solver = make_conjugate_gradient(options);
    solver->analyze(system.lower);
    solver->set_places(system.places);
    std::array<int, 2> iterations{};
    for (int& each : iterations) {
      REQUIRE(solver->factorize(system.lower).ok());
      MatrixXd x = MatrixXd::Zero(rhs.rows(), 1);
      const SolveReport report = solver->solve(rhs, x);
      CHECK(report.ok());
      CHECK(relative_error(full_of(system.lower) * x, rhs) < 1.01 * options.tolerance);
      each = report.iterations;
    }
    return iterations;
  };
  const auto [alone, alone_again] = iterations_twice(Preconditioner::incomplete_factor);
  const auto [first, second] = iterations_twice(Preconditioner::multigrid);
  CHECK(first != alone);
  CHECK(second == alone_again);
}

TEST_CASE("multigrid: nothing is allocated again for the same pattern", "[linalg]") {
  if (!counts_allocations()) return;
  const Placed system = sheet(20);
  Random random(5);
  const MatrixXd rhs = random_columns(system.lower.rows(), 1, random);
  for (const Preconditioner preconditioner :
       {Preconditioner::multigrid, Preconditioner::automatic}) {
    SolverOptions options;
    options.preconditioner = preconditioner;
    const auto solver = make_conjugate_gradient(options);
    solver->analyze(system.lower);
    const auto run = [&] {
      MatrixXd x = MatrixXd::Zero(rhs.rows(), 1);
      solver->set_places(system.places);
      return solver->factorize(system.lower).ok() && solver->solve(rhs, x).ok();
    };
    REQUIRE((run() && run()));
    CHECK(allocations_in([&] {
            solver->set_places(system.places);
            return solver->factorize(system.lower).ok();
          }) == 0);
    MatrixXd x = MatrixXd::Zero(rhs.rows(), 1);
    CHECK(allocations_in([&] { return solver->solve(rhs, x).ok(); }) == 0);
  }
}

}  // namespace pleat
