#include "native-tests/support/linear_systems.h"

namespace pleat {

using Eigen::MatrixXd;

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

}  // namespace pleat
