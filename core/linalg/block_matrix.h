#pragma once

#include <vector>

#include "core/linalg/sparse.h"

namespace pleat {

/// Symmetric 3 x 3 block, its lower triangle row by row: 00 10 11 20 21 22.
inline constexpr int kPackedSize = 6;
/// Any 3 x 3 block, row by row.
inline constexpr int kBlockSize = 9;

/// y = S x for a packed symmetric block.
inline void multiply_packed(const double* S, const double* x, double* y) {
  y[0] = S[0] * x[0] + S[1] * x[1] + S[3] * x[2];
  y[1] = S[1] * x[0] + S[2] * x[1] + S[4] * x[2];
  y[2] = S[3] * x[0] + S[4] * x[1] + S[5] * x[2];
}

/// Inverse of a packed block through its Cholesky factor. False unless every Cholesky pivot is
/// positive.
bool invert_packed(const double* S, double* inverse);

/// The other block rows with which each one has a block, ascending.
std::vector<std::vector<int>> block_neighbours(const SparseMatrix& lower);

/// Symmetric matrix in 3 x 3 blocks, those below the diagonal held once, row by row. Its rows have
/// an order of their own, in which neighbours are near each other (reverse King order).
class BlockMatrix {
 public:
  /// Takes the pattern of the lower triangle; its size is a multiple of 3. Entries that are missing
  /// in a block are zero.
  void analyze(const SparseMatrix& lower);

  /// Takes the values; the pattern is the one last analysed.
  void set_values(const SparseMatrix& lower);

  /// Reorder from the order of the sparse matrix to that of the rows, and back; 3 n_rows() each.
  void gather(const double* from, double* ordered) const;
  void scatter(const double* ordered, double* to) const;

  /// y = A x, both in the order of the rows. x and y do not overlap.
  void multiply(const double* x, double* y) const;

  int n_rows() const { return n_rows_; }  ///< number of rows of blocks
  const double* diagonal_block(int row) const { return values_.data() + row * kPackedSize; }
  double* diagonal_block(int row) { return values_.data() + row * kPackedSize; }
  /// Index into the sparse matrix of the first entry of a row.
  int source(int row) const { return 3 * source_rows_[static_cast<std::size_t>(row)]; }

  /// The blocks below the diagonal are numbered row by row: those of a row end where those of the
  /// next begin.
  int begin(int row) const { return row_begins_[static_cast<std::size_t>(row)]; }
  int column(int block) const { return columns_[static_cast<std::size_t>(block)]; }
  const double* block(int block) const {
    return values_.data() + n_rows_ * kPackedSize + block * kBlockSize;
  }
  double* block(int block) { return values_.data() + n_rows_ * kPackedSize + block * kBlockSize; }

 private:
  int n_rows_ = 0;
  std::vector<int> source_rows_;   // row of each one in the sparse matrix's blocks
  std::vector<int> row_begins_;    // first of each row in columns_, one more than there are rows
  std::vector<int> columns_;       // column of each block below the diagonal
  std::vector<int> destinations_;  // place in values_ of each entry of the sparse matrix
  std::vector<double> values_;     // packed diagonal blocks, then the others
};

}  // namespace pleat
