#include "core/linalg/iterative/incomplete_factor.h"

#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch.hpp>

#include "native-tests/support/finite_difference.h"
#include "native-tests/support/linear_systems.h"

namespace pleat {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// B's, if it is larger than a hundredth of the smaller trace.
MatrixXd positive_part(const MatrixXd& B, const MatrixXd& D_i, const MatrixXd& D_j) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen((B + B.transpose()) / 2);
  if (eigen.eigenvalues().maxCoeff() <= 0.01 * std::min(D_i.trace(), D_j.trace()))
    return MatrixXd::Zero(3, 3);
  const VectorXd kept = eigen.eigenvalues().cwiseMax(0);
  return eigen.eigenvectors() * kept.asDiagonal() * eigen.eigenvectors().transpose();
}

/// The factor, and A, L and P by their definitions, dense and in the same order.
struct Factored {
  IncompleteFactor factor;
  MatrixXd A, L, D, P;
  int n_positive = 0;  // blocks
  int n_lost = 0;      // pivots

  explicit Factored(const SparseMatrix& lower) {
    factor.analyze(lower);
    REQUIRE(factor.compute(lower) == -1);
    const BlockMatrix& rows = factor.rows();

    const Index n = lower.rows();
    const MatrixXd full = full_of(lower);
    A = L = D = P = MatrixXd::Zero(n, n);
    for (Index r = 0; r < n; ++r)
      for (Index c = 0; c < n; ++c)
        A(r, c) = full(rows.source(static_cast<int>(r / 3)) + r % 3,
                       rows.source(static_cast<int>(c / 3)) + c % 3);
    const auto block = [](MatrixXd& matrix, Index i, Index j) { return matrix.block<3, 3>(i, j); };
    for (Index i = 0; i < n; i += 3) {
      block(D, i, i) += block(A, i, i);
      for (Index j = 0; j < i; j += 3) {
        const MatrixXd positive = positive_part(block(A, i, j), block(A, i, i), block(A, j, j));
        if (!positive.isZero(0)) ++n_positive;
        block(L, i, j) = block(A, i, j) - positive;
        block(D, i, i) += positive;
        block(D, j, j) += positive;
      }
    }
    for (Index i = 0; i < n; i += 3) {
      MatrixXd pivot = block(D, i, i);
      for (Index j = 0; j < i; j += 3)
        pivot -= block(L, i, j) * block(P, j, j).inverse() * block(L, i, j).transpose();
      const bool is_lost = !(pivot.trace() > 1e-8 * block(D, i, i).trace()) ||
                           Eigen::LLT<MatrixXd>(pivot).info() != Eigen::Success;
      if (is_lost) ++n_lost;
      block(P, i, i) = is_lost ? MatrixXd(block(D, i, i)) : pivot;
    }
  }
};

/// Springs on a grid, their directions random, and more of them between vertices and the middles of
/// two others: what becomes of springs when vertices hang.
SparseMatrix grid_with_middles() {
  MatrixXd A = full_of(grid_system(7, 3));
  Random random(4);
  for (Index vertex = 8; vertex < 49; vertex += 3) {
    MatrixXd stretch = MatrixXd::Zero(1, A.cols());
    const MatrixXd direction = random_columns(1, 3, random);
    stretch.middleCols(3 * vertex, 3) = direction;
    stretch.middleCols(3 * (vertex - 8), 3) = -direction / 2;
    stretch.middleCols(3 * (vertex - 7), 3) = -direction / 2;
    A += 4 * stretch.transpose() * stretch;
  }
  return lower_of(A);
}

void check_against_definition(const Factored& f) {
  const Index n = f.A.rows();
  Random random(6);
  const VectorXd p = random_columns(n, 1, random);
  const MatrixXd PL = f.P + f.L;

  VectorXd image(n);
  f.factor.multiply(p.data(), image.data());
  CHECK(relative_error(image, f.A * p) < 1e-12);

  VectorXd z(n);
  CHECK(f.factor.multiply_pivots(p.data(), z.data()) == Approx(p.dot(f.P * p)).epsilon(1e-12));
  CHECK(relative_error(z, f.P * p) < 1e-12);

  VectorXd x = p;
  f.factor.solve_lower(x.data(), x.data());
  CHECK(relative_error(PL * x, p) < 1e-9);
  CHECK(f.factor.norm_of_lower_product(p.data()) == Approx((PL * p).norm()).epsilon(1e-12));

  VectorXd t(n);
  VectorXd s = VectorXd::Zero(n);
  const double curvature = f.factor.apply(p.data(), t.data(), s.data());
  CHECK(relative_error(PL.transpose() * t, p) < 1e-9);
  CHECK(relative_error(PL * (t + s), f.A * t) < 1e-9);
  CHECK(curvature == Approx(t.dot(f.A * t)).epsilon(1e-9));
}

}  // namespace

TEST_CASE("linalg: an incomplete factor has the blocks of its matrix", "[linalg]") {
  const Factored f(grid_system(7, 3));
  CHECK(f.n_positive == 0);
  CHECK(f.n_lost == 0);
  const MatrixXd M = (f.P + f.L) * f.P.inverse() * (f.P + f.L).transpose();
  for (Index i = 0; i < M.rows(); i += 3)
    CHECK(relative_error(M.block<3, 3>(i, i), f.A.block<3, 3>(i, i)) < 1e-12);
  check_against_definition(f);
}

TEST_CASE("linalg: positive parts of blocks cost no pivot", "[linalg]") {
  const Factored f(grid_with_middles());
  CHECK(f.n_positive > 0);
  CHECK(f.n_lost == 0);
  check_against_definition(f);
}

TEST_CASE("linalg: a pivot that is lost is the diagonal's block again", "[linalg]") {
  MatrixXd chain = full_of(graph_system(4, {{0, 1}, {1, 2}, {2, 3}}, 4));
  chain.diagonal().array() += 1e-12 - 0.1;  // hardly held: all of it is left to the last pivot
  const Factored f(lower_of(chain));
  CHECK(f.n_lost == 1);
  check_against_definition(f);
}

TEST_CASE("linalg: an incomplete factor of new values knows nothing of the old ones", "[linalg]") {
  MatrixXd A = 3 * MatrixXd::Identity(6, 6);
  A(0, 4) = A(4, 0) = A(1, 3) = A(3, 1) = 1;  // blocks with holes in the pattern
  IncompleteFactor factor;
  factor.analyze(lower_of(A));
  Random random(2);
  const VectorXd x = random_columns(6, 1, random);
  for (int time = 0; time < 3; ++time) {
    REQUIRE(factor.compute(lower_of(A)) == -1);
    VectorXd ordered(6);
    VectorXd image(6);
    VectorXd found(6);
    factor.rows().gather(x.data(), ordered.data());
    factor.multiply(ordered.data(), image.data());
    factor.rows().scatter(image.data(), found.data());
    CHECK(relative_error(found, A * x) < 1e-14);
  }
}

TEST_CASE("linalg: what is lifted hides no diagonal block that is not definite", "[linalg]") {
  MatrixXd A = MatrixXd::Identity(6, 6);
  A(0, 0) = -0.5;
  A(3, 0) = A(0, 3) = 1;
  IncompleteFactor factor;
  factor.analyze(lower_of(A));
  CHECK(factor.compute(lower_of(A)) >= 0);
}

}  // namespace pleat
