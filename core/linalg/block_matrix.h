#pragma once

#include <vector>

#include "core/linalg/sparse.h"

namespace pleat {

/// Symmetric N x N block, its lower triangle row by row.
template <int N>
inline constexpr int kPackedSize = N*(N + 1) / 2;

/// y = S x for a packed symmetric block.
template <int N>
inline void multiply_packed(const double* S, const double* x, double* y) {
  if constexpr (N == 1) {
    y[0] = S[0] * x[0];
  } else {
    static_assert(N == 3);
    y[0] = S[0] * x[0] + S[1] * x[1] + S[3] * x[2];
    y[1] = S[1] * x[0] + S[2] * x[1] + S[4] * x[2];
    y[2] = S[3] * x[0] + S[4] * x[1] + S[5] * x[2];
  }
}

/// Symmetric matrix in N x N blocks, N = 1 or 3. Blocks below the diagonal are held once, row by
/// row, and used twice, which halves the memory that a product has to read.
template <int N>
class BlockMatrix {
 public:
  /// Takes the pattern of the lower triangle; its size is a multiple of N. Entries that are missing
  /// in a block are zero.
  void analyze(const SparseMatrix& lower);

  /// Takes the values; the pattern is the one last analysed.
  void set_values(const SparseMatrix& lower);

  /// y = A x. Returns x'A x. x and y do not overlap.
  double multiply(const double* x, double* y) const;

  int n_rows() const { return n_rows_; }  ///< in blocks
  const double* diagonal_block(int row) const { return values_.data() + row * kPackedSize<N>; }

 private:
  int n_rows_ = 0;
  std::vector<int> row_begins_;    // into columns_, one more than there are rows
  std::vector<int> columns_;       // of each block below the diagonal, in blocks
  std::vector<int> destinations_;  // into values_, for each entry of the sparse matrix
  std::vector<double>
      values_;  // packed diagonal blocks, then the others row by row (row-major inside)
};

extern template class BlockMatrix<1>;
extern template class BlockMatrix<3>;

}  // namespace pleat
