#include "core/linalg/direct/supernodes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "native-tests/support/linear_systems.h"

namespace pleat {
namespace {

using Eigen::MatrixXd;

MatrixXd in_order(const MatrixXd& A, const std::vector<int>& order) {
  MatrixXd ordered(A.rows(), A.cols());
  for (Eigen::Index row = 0; row < A.rows(); ++row)
    for (Eigen::Index column = 0; column < A.cols(); ++column)
      ordered(row, column) =
          A(order[static_cast<std::size_t>(row)], order[static_cast<std::size_t>(column)]);
  return ordered;
}

/// Two systems that do not meet.
SparseMatrix side_by_side(const SparseMatrix& a, const SparseMatrix& b) {
  MatrixXd both = MatrixXd::Zero(a.rows() + b.rows(), a.rows() + b.rows());
  both.topLeftCorner(a.rows(), a.rows()) = full_of(a);
  both.bottomRightCorner(b.rows(), b.rows()) = full_of(b);
  return lower_of(both);
}

SparseMatrix system(int kind) {
  switch (kind) {
    case 0:
      return grid_system(9, 5);
    case 1:
      return random_system(70, 6);
    case 2:
      return side_by_side(grid_system(5, 7), random_system(30, 8));
    default:
      return lower_of(MatrixXd::Identity(7, 7));
  }
}

}  // namespace

TEST_CASE("supernodes: every row is eliminated once", "[linalg]") {
  const SparseMatrix lower = system(GENERATE(0, 1, 2, 3));
  const Supernodes supernodes = find_supernodes(lower);
  std::vector<int> sorted = supernodes.order;
  std::sort(sorted.begin(), sorted.end());
  REQUIRE(static_cast<Eigen::Index>(sorted.size()) == lower.rows());
  for (std::size_t k = 0; k < sorted.size(); ++k) CHECK(sorted[k] == static_cast<int>(k));
  int next = 0;
  for (const Supernodes::Node& node : supernodes.nodes) {
    CHECK(node.first == next);
    next += node.n_columns;
  }
  CHECK(next == lower.rows());
}

TEST_CASE("supernodes: groups have the rows of a dense factor", "[linalg]") {
  const SparseMatrix lower = system(GENERATE(0, 1, 2, 3));
  const Supernodes supernodes = find_supernodes(lower);
  const MatrixXd L = in_order(full_of(lower), supernodes.order).llt().matrixL();
  for (const Supernodes::Node& node : supernodes.nodes) {
    const auto begin = supernodes.rows.begin() + node.rows_begin;
    const std::vector<int> rows(begin, begin + node.n_rows);
    CHECK(std::is_sorted(rows.begin(), rows.end()));
    for (int column = node.first; column < node.first + node.n_columns; ++column) {
      CHECK(rows[static_cast<std::size_t>(column - node.first)] == column);
      for (int row = column; row < L.rows(); ++row)
        if (L(row, column) != 0) CHECK(std::binary_search(rows.begin(), rows.end(), row));
    }
  }
}

TEST_CASE("supernodes: what is left of children is among their parent's rows", "[linalg]") {
  const SparseMatrix lower = system(GENERATE(0, 1, 2, 3));
  const Supernodes supernodes = find_supernodes(lower);
  std::vector<std::vector<int>> waiting;
  for (const Supernodes::Node& node : supernodes.nodes) {
    const auto begin = supernodes.rows.begin() + node.rows_begin;
    REQUIRE(waiting.size() >= static_cast<std::size_t>(node.n_children));
    for (int child = 0; child < node.n_children; ++child) {
      for (const int row : waiting.back())
        CHECK(std::binary_search(begin, begin + node.n_rows, row));
      waiting.pop_back();
    }
    if (node.n_rows > node.n_columns)
      waiting.emplace_back(begin + node.n_columns, begin + node.n_rows);
  }
  CHECK(waiting.empty());
}

TEST_CASE("supernodes: the columns of a vertex stay together", "[linalg]") {
  const Supernodes supernodes = find_supernodes(grid_system(9, 5));
  for (std::size_t k = 0; k < supernodes.order.size(); k += 3) {
    CHECK(supernodes.order[k] % 3 == 0);
    CHECK(supernodes.order[k + 1] == supernodes.order[k] + 1);
    CHECK(supernodes.order[k + 2] == supernodes.order[k] + 2);
  }
}

}  // namespace pleat
