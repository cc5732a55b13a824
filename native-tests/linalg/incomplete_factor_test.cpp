#include "core/linalg/incomplete_factor.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <vector>

#include "core/linalg/conjugate_gradient.h"
#include "native-tests/support/finite_difference.h"
#include "native-tests/support/linear_systems.h"

namespace pleat {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The factor, and by its definition, dense and in the same order, A, L and P.
struct Factored {
  BlockMatrix blocks;
  IncompleteFactor factor{blocks};
  MatrixXd A, L, P;

  explicit Factored(const SparseMatrix& lower) {
    blocks.analyze(lower);
    blocks.set_values(lower);
    factor.analyze();
    REQUIRE(factor.compute() == -1);

    const auto n = lower.rows();
    const MatrixXd full = full_of(lower);
    A.resize(n, n);
    for (Eigen::Index r = 0; r < n; ++r)
      for (Eigen::Index c = 0; c < n; ++c)
        A(r, c) = full(blocks.source(static_cast<int>(r / 3)) + r % 3,
                       blocks.source(static_cast<int>(c / 3)) + c % 3);
    L = P = MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; i += 3) {
      P.block<3, 3>(i, i) = A.block<3, 3>(i, i);
      for (Eigen::Index j = 0; j < i; j += 3) {
        L.block<3, 3>(i, j) = A.block<3, 3>(i, j);
        P.block<3, 3>(i, i) -=
            L.block<3, 3>(i, j) * P.block<3, 3>(j, j).inverse() * L.block<3, 3>(i, j).transpose();
      }
    }
  }
};

SparseMatrix system_of(bool grid) {
  if (grid) return grid_system(7, 3);
  std::vector<std::array<int, 2>> edges;
  for (int vertex = 1; vertex < 40; ++vertex) {
    edges.push_back({vertex, vertex / 3});
    edges.push_back({vertex, (7 * vertex) % 40});
  }
  edges.erase(
      std::remove_if(edges.begin(), edges.end(), [](const auto& e) { return e[0] == e[1]; }),
      edges.end());
  return graph_system(40, edges, 4);
}

}  // namespace

TEST_CASE("linalg: an incomplete factor is that of its definition", "[linalg]") {
  const bool grid = GENERATE(true, false);
  CAPTURE(grid);
  const Factored f(system_of(grid));
  const auto n = f.A.rows();
  Random random(6);
  const VectorXd p = random_columns(n, 1, random);
  const MatrixXd PL = f.P + f.L;

  const MatrixXd M = PL * f.P.inverse() * PL.transpose();
  for (Eigen::Index i = 0; i < n; i += 3)
    CHECK(relative_error(M.block<3, 3>(i, i), f.A.block<3, 3>(i, i)) < 1e-12);

  VectorXd z(n);
  CHECK(f.factor.multiply_pivots(p.data(), z.data()) == Approx(p.dot(f.P * p)).epsilon(1e-12));
  CHECK(relative_error(z, f.P * p) < 1e-12);

  VectorXd x = p;
  f.factor.solve_lower(x.data(), x.data());
  CHECK(relative_error(PL * x, p) < 1e-12);
  CHECK(f.factor.norm_of_lower_product(p.data()) == Approx((PL * p).norm()).epsilon(1e-12));

  VectorXd t(n);
  VectorXd s = VectorXd::Zero(n);
  const double curvature = f.factor.apply(p.data(), t.data(), s.data());
  CHECK(relative_error(PL.transpose() * t, p) < 1e-12);
  CHECK(relative_error(PL * (t + s), f.A * t) < 1e-12);
  CHECK(curvature == Approx(t.dot(f.A * t)).epsilon(1e-12));
}

// With c = 0.9 the third pivot of (1 - c) I + c 1 1' would be 1 - c^2 - c^2 / (1 - c^2) < 0.
TEST_CASE("linalg: a pivot that is lost is the diagonal's block again", "[linalg]") {
  const Eigen::Index n = 12;
  MatrixXd A = MatrixXd::Zero(3 * n, 3 * n);
  for (Eigen::Index r = 0; r < n; ++r)
    for (Eigen::Index c = 0; c < n; ++c)
      A.block<3, 3>(3 * r, 3 * c).diagonal().setConstant(r == c ? 1.0 : 0.9);
  const auto solver = make_conjugate_gradient({1e-10, 100});
  solver->analyze(lower_of(A));
  REQUIRE(solver->factorize(lower_of(A)).ok());
  Random random(6);
  const MatrixXd rhs = random_columns(3 * n, 1, random);
  MatrixXd x = MatrixXd::Zero(3 * n, 1);
  REQUIRE(solver->solve(rhs, x).ok());
  CHECK(relative_error(A * x, rhs) < 1e-9);
}

}  // namespace pleat
