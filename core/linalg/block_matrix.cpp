#include "core/linalg/block_matrix.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/base/check.h"
#include "core/linalg/king_ordering.h"

namespace pleat {
namespace {

/// a += B x and y += B' z for a row-major block, so that each entry is read once.
inline void multiply_both_ways(const double* B, const double* x, const double* z, double* a,
                               double* y) {
  a[0] += B[0] * x[0] + B[1] * x[1] + B[2] * x[2];
  a[1] += B[3] * x[0] + B[4] * x[1] + B[5] * x[2];
  a[2] += B[6] * x[0] + B[7] * x[1] + B[8] * x[2];
  y[0] += B[0] * z[0] + B[3] * z[1] + B[6] * z[2];
  y[1] += B[1] * z[0] + B[4] * z[1] + B[7] * z[2];
  y[2] += B[2] * z[0] + B[5] * z[1] + B[8] * z[2];
}

}  // namespace

std::vector<std::vector<int>> block_neighbours(const SparseMatrix& lower) {
  PLEAT_CHECK(lower.rows() % 3 == 0, "the size of the matrix must be a multiple of 3");
  std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(lower.rows() / 3));
  for (Eigen::Index column = 0; column < lower.cols(); ++column) {
    const int b = static_cast<int>(column) / 3;
    for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry) {
      const int a = static_cast<int>(entry.row()) / 3;
      if (a == b) continue;
      neighbours[static_cast<std::size_t>(a)].push_back(b);
      neighbours[static_cast<std::size_t>(b)].push_back(a);
    }
  }
  for (std::vector<int>& nodes : neighbours) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  return neighbours;
}

bool invert_packed(const double* S, double* inverse) {
  if (!(S[0] > 0)) return false;
  const double l00 = std::sqrt(S[0]);
  const double l10 = S[1] / l00;
  const double l20 = S[3] / l00;
  const double pivot_1 = S[2] - l10 * l10;
  if (!(pivot_1 > 0)) return false;
  const double l11 = std::sqrt(pivot_1);
  const double l21 = (S[4] - l20 * l10) / l11;
  const double pivot_2 = S[5] - l20 * l20 - l21 * l21;
  if (!(pivot_2 > 0)) return false;
  const double l22 = std::sqrt(pivot_2);

  // With S = C C', the inverse is V'V for V = C^-1.
  const double v00 = 1 / l00;
  const double v11 = 1 / l11;
  const double v22 = 1 / l22;
  const double v10 = -l10 * v00 * v11;
  const double v21 = -l21 * v11 * v22;
  const double v20 = -(l20 * v00 + l21 * v10) * v22;
  inverse[0] = v00 * v00 + v10 * v10 + v20 * v20;
  inverse[1] = v10 * v11 + v20 * v21;
  inverse[2] = v11 * v11 + v21 * v21;
  inverse[3] = v20 * v22;
  inverse[4] = v21 * v22;
  inverse[5] = v22 * v22;
  return true;
}

void BlockMatrix::analyze(const SparseMatrix& lower) {
  n_rows_ = static_cast<int>(lower.rows() / 3);
  const std::vector<std::vector<int>> neighbours = block_neighbours(lower);
  source_rows_ = reverse_king_ordering(neighbours);
  std::vector<int> row_of(source_rows_.size());
  for (int row = 0; row < n_rows_; ++row)
    row_of[static_cast<std::size_t>(source_rows_[static_cast<std::size_t>(row)])] = row;

  row_begins_.assign(1, 0);
  columns_.clear();
  for (int row = 0; row < n_rows_; ++row) {
    for (const int node :
         neighbours[static_cast<std::size_t>(source_rows_[static_cast<std::size_t>(row)])]) {
      const int column = row_of[static_cast<std::size_t>(node)];
      if (column < row) columns_.push_back(column);
    }
    std::sort(columns_.begin() + row_begins_.back(), columns_.end());
    row_begins_.push_back(static_cast<int>(columns_.size()));
  }

  const int others_begin = n_rows_ * kPackedSize;
  values_.assign(static_cast<std::size_t>(others_begin) + columns_.size() * kBlockSize, 0.0);
  destinations_.clear();
  destinations_.reserve(static_cast<std::size_t>(lower.nonZeros()));
  for (Eigen::Index sparse_column = 0; sparse_column < lower.cols(); ++sparse_column) {
    for (SparseMatrix::InnerIterator entry(lower, sparse_column); entry; ++entry) {
      int r = static_cast<int>(entry.row()) % 3;
      int c = static_cast<int>(sparse_column) % 3;
      int row = row_of[static_cast<std::size_t>(entry.row() / 3)];
      int column = row_of[static_cast<std::size_t>(sparse_column / 3)];
      if (row == column) {
        destinations_.push_back(row * kPackedSize + r * (r + 1) / 2 + c);
        continue;
      }
      if (row < column) {
        std::swap(row, column);
        std::swap(r, c);
      }
      const auto block = std::lower_bound(columns_.begin() + begin(row),
                                          columns_.begin() + begin(row + 1), column) -
                         columns_.begin();
      destinations_.push_back(others_begin + static_cast<int>(block) * kBlockSize + r * 3 + c);
    }
  }
}

void BlockMatrix::set_values(const SparseMatrix& lower) {
  std::fill(values_.begin(), values_.end(), 0.0);  // blocks may have been changed in place
  const double* source = lower.valuePtr();
  for (std::size_t k = 0; k < destinations_.size(); ++k)
    values_[static_cast<std::size_t>(destinations_[k])] = source[k];
}

void BlockMatrix::gather(const double* from, double* ordered) const {
  for (int row = 0; row < n_rows_; ++row)
    for (int k = 0; k < 3; ++k) ordered[3 * row + k] = from[source(row) + k];
}

void BlockMatrix::scatter(const double* ordered, double* to) const {
  for (int row = 0; row < n_rows_; ++row)
    for (int k = 0; k < 3; ++k) to[source(row) + k] = ordered[3 * row + k];
}

// Row i adds its own part to y_i and, through the transposed blocks, to the earlier y_j: those were
// begun before.
void BlockMatrix::multiply(const double* x, double* y) const {
  for (int row = 0; row < n_rows_; ++row) {
    const double* x_row = x + 3 * row;
    double* y_row = y + 3 * row;
    multiply_packed(diagonal_block(row), x_row, y_row);
    for (int k = begin(row); k < begin(row + 1); ++k)
      multiply_both_ways(block(k), x + 3 * column(k), x_row, y_row, y + 3 * column(k));
  }
}

}  // namespace pleat
