#include "core/linalg/aggregation/dense_factor.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "native-tests/support/finite_difference.h"
#include "native-tests/support/linear_systems.h"

namespace pleat {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

VectorXd solved(const MatrixXd& A, VectorXd b) {
  DenseFactor factor;
  factor.resize(static_cast<int>(A.rows()));
  for (int r = 0; r < A.rows(); ++r)
    for (int c = 0; c <= r; ++c) factor.entry(r, c) = A(r, c);
  factor.compute();
  factor.solve(b.data());
  return b;
}

}  // namespace

TEST_CASE("linalg: a dense factor solves as Eigen's does", "[linalg]") {
  const MatrixXd A = full_of(grid_system(4, 3));
  Random random(2);
  const VectorXd b = random_columns(A.rows(), 1, random);
  CHECK(relative_error(solved(A, b), A.ldlt().solve(b)) < 1e-12);
}

TEST_CASE("linalg: an unknown without a pivot is zero, the others are solved", "[linalg]") {
  MatrixXd A(3, 3);
  A << 4, 2, 0, 2, 1, 0, 0, 0, 5;  // the second row is half of the first
  CHECK(relative_error(solved(A, VectorXd::Ones(3)), Eigen::Vector3d(0.25, 0, 0.2)) < 1e-15);
}

}  // namespace pleat
