#pragma once

#include <vector>

#include "core/base/vec.h"

namespace pleat {

/// A lower triangular matrix L by columns, each with its rows from the diagonal down. The row below
/// a column's diagonal is the first column that has all of its other rows too, as in every Cholesky
/// factor.
struct LowerColumns {
  int n = 0;
  const int* starts = nullptr;   ///< first entry for each column
  const int* lengths = nullptr;  ///< entries for each column
  const int* rows = nullptr;     ///< row for each entry
  const double* values = nullptr;
};

/// Solves P' L L' P X = B for few columns X at once, four of L at a time where their rows are the
/// same. Its order of sums is the same in every build.
class ColumnSolve {
 public:
  /// Looks at the rows of L: which columns go together.
  void prepare(const LowerColumns& L);

  /// permutation  row of the matrix for each row of L
  /// rhs          n x m
  void solve(const LowerColumns& L, const int* permutation,
             const Eigen::Ref<const Eigen::MatrixXd>& rhs, Eigen::Ref<Eigen::MatrixXd> solution);

 private:
  template <class Lanes>
  void solve_lanes(const LowerColumns& L, const int* permutation,
                   const Eigen::Ref<const Eigen::MatrixXd>& rhs,
                   Eigen::Ref<Eigen::MatrixXd> solution, Eigen::Index first);

  std::vector<int> blocks_;   // first column of each group of columns, and n
  std::vector<double> rows_;  // right-hand side, then solution, a group of lanes for each row
};

}  // namespace pleat
