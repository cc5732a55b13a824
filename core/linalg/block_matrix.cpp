#include "core/linalg/block_matrix.h"

#include <algorithm>
#include <cstddef>

#include "core/base/check.h"

namespace pleat {
namespace {

/// a += B x and y += B' z for a row-major block, so that each entry is read once.
template <int N>
inline void multiply_both_ways(const double* B, const double* x, const double* z, double* a,
                               double* y) {
  if constexpr (N == 1) {
    a[0] += B[0] * x[0];
    y[0] += B[0] * z[0];
  } else {
    static_assert(N == 3);
    a[0] += B[0] * x[0] + B[1] * x[1] + B[2] * x[2];
    a[1] += B[3] * x[0] + B[4] * x[1] + B[5] * x[2];
    a[2] += B[6] * x[0] + B[7] * x[1] + B[8] * x[2];
    y[0] += B[0] * z[0] + B[3] * z[1] + B[6] * z[2];
    y[1] += B[1] * z[0] + B[4] * z[1] + B[7] * z[2];
    y[2] += B[2] * z[0] + B[5] * z[1] + B[8] * z[2];
  }
}

}  // namespace

template <int N>
void BlockMatrix<N>::analyze(const SparseMatrix& lower) {
  PLEAT_CHECK(lower.rows() % N == 0, "the size of the matrix must be a multiple of the block size");
  n_rows_ = static_cast<int>(lower.rows() / N);

  // Going through the block columns in order leaves the blocks of each row sorted.
  std::vector<std::vector<int>> row_columns(static_cast<std::size_t>(n_rows_));
  for (Eigen::Index column = 0; column < lower.cols(); ++column) {
    const int block_column = static_cast<int>(column) / N;
    for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry) {
      const int block_row = static_cast<int>(entry.row()) / N;
      if (block_row == block_column) continue;
      std::vector<int>& columns = row_columns[static_cast<std::size_t>(block_row)];
      if (columns.empty() || columns.back() != block_column) columns.push_back(block_column);
    }
  }
  row_begins_.assign(1, 0);
  columns_.clear();
  for (const std::vector<int>& columns : row_columns) {
    columns_.insert(columns_.end(), columns.begin(), columns.end());
    row_begins_.push_back(static_cast<int>(columns_.size()));
  }

  const int others_begin = n_rows_ * kPackedSize<N>;
  values_.assign(static_cast<std::size_t>(others_begin) + columns_.size() * N * N, 0.0);
  destinations_.clear();
  destinations_.reserve(static_cast<std::size_t>(lower.nonZeros()));
  for (Eigen::Index column = 0; column < lower.cols(); ++column) {
    const int block_column = static_cast<int>(column) / N;
    const int c = static_cast<int>(column) % N;
    for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry) {
      const int block_row = static_cast<int>(entry.row()) / N;
      const int r = static_cast<int>(entry.row()) % N;
      if (block_row == block_column) {
        destinations_.push_back(block_row * kPackedSize<N> + r * (r + 1) / 2 + c);
        continue;
      }
      const auto begin = columns_.begin() + row_begins_[static_cast<std::size_t>(block_row)];
      const auto end = columns_.begin() + row_begins_[static_cast<std::size_t>(block_row) + 1];
      const auto block = std::lower_bound(begin, end, block_column) - columns_.begin();
      destinations_.push_back(others_begin + static_cast<int>(block) * N * N + r * N + c);
    }
  }
}

template <int N>
void BlockMatrix<N>::set_values(const SparseMatrix& lower) {
  const double* source = lower.valuePtr();
  for (std::size_t k = 0; k < destinations_.size(); ++k) {
    values_[static_cast<std::size_t>(destinations_[k])] = source[k];
  }
}

// Row i adds its own part to y_i and, through the transposed blocks, to the earlier y_j: those were
// begun before. x'A x = sum_i x_i'(D_i x_i + 2 sum_{j<i} A_ij x_j), whose terms are all at hand in
// row i.
template <int N>
double BlockMatrix<N>::multiply(const double* x, double* y) const {
  const double* diagonal = values_.data();
  const double* block = values_.data() + static_cast<std::ptrdiff_t>(n_rows_) * kPackedSize<N>;
  const int* column = columns_.data();
  double product = 0;
  for (int row = 0; row < n_rows_; ++row, diagonal += kPackedSize<N>) {
    const double* x_row = x + row * N;
    double x_own[N];
    double lower_part[N] = {};
    for (int r = 0; r < N; ++r) x_own[r] = x_row[r];
    const int* end = columns_.data() + row_begins_[static_cast<std::size_t>(row) + 1];
    for (; column != end; ++column, block += N * N) {
      multiply_both_ways<N>(block, x + *column * N, x_own, lower_part, y + *column * N);
    }
    double diagonal_part[N];
    multiply_packed<N>(diagonal, x_own, diagonal_part);
    for (int r = 0; r < N; ++r) {
      y[row * N + r] = diagonal_part[r] + lower_part[r];
      product += x_own[r] * (diagonal_part[r] + 2 * lower_part[r]);
    }
  }
  return product;
}

template class BlockMatrix<1>;
template class BlockMatrix<3>;

}  // namespace pleat
