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

SparseMatrix graph_system(int n_vertices, const std::vector<std::array<int, 2>>& edges,
                          std::uint64_t seed) {
  Random random(seed);
  MatrixXd A = 0.1 * MatrixXd::Identity(3 * n_vertices, 3 * n_vertices);
  for (const auto& [a, b] : edges) {
    const MatrixXd half = random_columns(3, 3, random);
    const MatrixXd stiffness = half * half.transpose();
    A.block<3, 3>(3 * a, 3 * a) += stiffness;
    A.block<3, 3>(3 * b, 3 * b) += stiffness;
    A.block<3, 3>(3 * a, 3 * b) -= stiffness;
    A.block<3, 3>(3 * b, 3 * a) -= stiffness;
  }
  return lower_of(A);
}

SparseMatrix grid_system(int side, std::uint64_t seed) {
  std::vector<std::array<int, 2>> edges;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const int vertex = row * side + column;
      if (column + 1 < side) edges.push_back({vertex, vertex + 1});
      if (row + 1 < side) edges.push_back({vertex, vertex + side});
    }
  }
  return graph_system(side * side, edges, seed);
}

SparseMatrix random_system(int n_blocks, std::uint64_t seed) {
  Random random(seed);
  const int n = 3 * n_blocks;
  MatrixXd R = MatrixXd::Zero(n, n);
  for (int row = 0; row < n_blocks; ++row) {
    for (int column = 0; column < n_blocks; ++column) {
      if (random.below(3) != 0) continue;
      R.block<3, 3>(3 * row, 3 * column) = random_columns(3, 3, random);
    }
  }
  return lower_of(R * R.transpose() + MatrixXd::Identity(n, n));
}

}  // namespace pleat
