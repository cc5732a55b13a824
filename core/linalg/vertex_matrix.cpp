#include "core/linalg/vertex_matrix.h"

#include "core/base/check.h"

namespace pleat {

VertexMatrix::VertexMatrix(int n_vertices, std::span<const Pair> pairs)
    : below_(static_cast<std::size_t>(n_vertices)) {
  for (const auto& [a, b] : pairs) below_[std::min(a.value, b.value)].push_back(a > b ? a : b);
  std::vector<int> column_sizes;
  column_sizes.reserve(3 * below_.size());
  for (std::vector<VertexId>& rows : below_) {
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    for (int c = 0; c < 3; ++c) column_sizes.push_back(3 - c + 3 * static_cast<int>(rows.size()));
  }
  matrix_.resize(3 * n_vertices, 3 * n_vertices);
  matrix_.reserve(column_sizes);
  for (int j = 0; j < n_vertices; ++j) {
    for (int c = 0; c < 3; ++c) {
      for (int r = c; r < 3; ++r) matrix_.insert(3 * j + r, 3 * j + c) = 0;
      for (const VertexId i : below_[j])
        for (int r = 0; r < 3; ++r) matrix_.insert(3 * i + r, 3 * j + c) = 0;
    }
  }
  matrix_.makeCompressed();
}

VertexMatrix::Slot VertexMatrix::slot(VertexId a, VertexId b) const {
  const VertexId row = a > b ? a : b;
  const VertexId column = a > b ? b : a;
  const std::vector<VertexId>& rows = below_[column];
  const auto place = std::lower_bound(rows.begin(), rows.end(), row);
  return {row, column, static_cast<int>(place - rows.begin())};
}

std::vector<VertexMatrix::Slot> VertexMatrix::slots(std::span<const Pair> pairs) const {
  std::vector<Slot> slots;
  slots.reserve(pairs.size());
  for (const auto& [a, b] : pairs) slots.push_back(slot(a, b));
  return slots;
}

void VertexMatrix::set_values(const SparseMatrix& lower) {
  PLEAT_CHECK(lower.nonZeros() == matrix_.nonZeros(), "values come with the same pattern");
  matrix_.coeffs() = lower.coeffs();
}

void VertexMatrix::choose_prescribed(const std::vector<VertexId>& vertices) {
  prescribed_ = vertices;
  std::vector<int> index(below_.size(), -1);
  for (std::size_t k = 0; k < vertices.size(); ++k) index[vertices[k]] = static_cast<int>(k);
  prescribed_blocks_.clear();
  for (std::size_t j = 0; j < below_.size(); ++j) {
    for (std::size_t rank = 0; rank < below_[j].size(); ++rank) {
      const VertexId row = below_[j][rank];
      if (index[row] < 0 && index[j] < 0) continue;
      const Slot place{row, VertexId(static_cast<std::int64_t>(j)), static_cast<int>(rank)};
      prescribed_blocks_.push_back({place, index[row], index[j]});
    }
  }
}

void VertexMatrix::prescribe(const Eigen::Ref<const Positions>& values,
                             Eigen::Ref<Eigen::VectorXd> rhs) {
  PLEAT_CHECK(values.cols() == static_cast<Eigen::Index>(prescribed_.size()),
              "one value per prescribed vertex");
  for (const PrescribedBlock& entry : prescribed_blocks_) {
    for (int c = 0; c < 3; ++c) {
      double* column = block_column(entry.slot, c);
      for (int r = 0; r < 3; ++r) {
        if (entry.row_index < 0)
          rhs[3 * entry.slot.row + r] -= column[r] * values(c, entry.column_index);
        if (entry.column_index < 0)
          rhs[3 * entry.slot.column + c] -= column[r] * values(r, entry.row_index);
        column[r] = 0;
      }
    }
  }
  for (std::size_t k = 0; k < prescribed_.size(); ++k) {
    const VertexId v = prescribed_[k];
    for (int c = 0; c < 3; ++c) {
      double* diagonal = diagonal_column(v, c);
      for (int r = c; r < 3; ++r) diagonal[r - c] = r == c ? 1 : 0;
      rhs[3 * v + c] = values(c, static_cast<Eigen::Index>(k));
    }
  }
}

}  // namespace pleat
