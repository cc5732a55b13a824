#include "core/model/system_matrix.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/model/hanging_vertices.h"

namespace pleat {

namespace {

/// Calls join(a, b) for every pair of vertices that an element joins, in the order of assembly.
template <class Join>
void for_each_pair(const ClothModel& model, const Join& join) {
  for_each_element_kind(model, [&join](const auto& kind) { kind.for_each_pair(join); });
}

}  // namespace

SystemMatrix::SystemMatrix(const ClothModel& model) : model_(model) { join({}); }

void SystemMatrix::join(std::span<const std::array<VertexId, 2>> joins) {
  below_.assign(static_cast<std::size_t>(model_.n_vertices()), {});
  slots_.clear();
  hanging_blocks_.clear();
  prescribed_.clear();
  prescribed_blocks_.clear();
  const auto note = [this](VertexId a, VertexId b) {
    below_[std::min(a.value, b.value)].push_back(a > b ? a : b);
  };
  for_each_pair(model_, note);
  for (const auto& [a, b] : joins) note(a, b);
  if (!model_.hanging.empty()) join_parents();
  const int n = model_.n_vertices();
  std::vector<int> column_sizes;
  column_sizes.reserve(3 * static_cast<std::size_t>(n));
  for (std::vector<VertexId>& rows : below_) {
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    for (int c = 0; c < 3; ++c) column_sizes.push_back(3 - c + 3 * static_cast<int>(rows.size()));
  }
  matrix_.resize(3 * n, 3 * n);
  matrix_.reserve(column_sizes);
  for (int j = 0; j < n; ++j) {
    for (int c = 0; c < 3; ++c) {
      for (int r = c; r < 3; ++r) matrix_.insert(3 * j + r, 3 * j + c) = 0;
      for (const VertexId i : below_[j])
        for (int r = 0; r < 3; ++r) matrix_.insert(3 * i + r, 3 * j + c) = 0;
    }
  }
  matrix_.makeCompressed();
  for_each_pair(model_, [this](VertexId a, VertexId b) { slots_.push_back(slot(a, b)); });
  find_hanging_slots();
}

/// Eliminates hanging vertices as `reduce_to_parents` will, to see what it fills. Neighbours may
/// hang too: what the first one leaves with the second goes on to the second one's parents.
void SystemMatrix::join_parents() {
  std::vector<std::vector<VertexId>> neighbours(below_.size());
  const auto note = [&neighbours](VertexId a, VertexId b) {
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  };
  for (std::size_t j = 0; j < below_.size(); ++j)
    for (const VertexId i : below_[j]) note(i, VertexId(static_cast<std::int64_t>(j)));
  const auto join = [&](VertexId a, VertexId b) {
    note(a, b);
    below_[std::min(a.value, b.value)].push_back(a > b ? a : b);
  };
  std::vector<bool> is_eliminated(below_.size(), false);
  for (const HangingVertex& h : model_.hanging) {
    std::vector<VertexId>& others = neighbours[h.vertex];
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    hanging_blocks_.push_back({h, {}, {}});
    for (const VertexId other : others) {
      if (is_eliminated[other]) continue;
      hanging_blocks_.back().blocks.push_back({other, {}, {}});
      for (const VertexId parent : h.parents)
        if (parent != other) join(parent, other);
    }
    join(h.parents[0], h.parents[1]);
    is_eliminated[h.vertex] = true;
  }
}

void SystemMatrix::find_hanging_slots() {
  for (HangingBlocks& h : hanging_blocks_) {
    const auto& parents = h.hanging.parents;
    h.between_parents = slot(parents[0], parents[1]);
    for (HangingBlock& block : h.blocks) {
      block.own = slot(h.hanging.vertex, block.other);
      for (std::size_t k = 0; k < 2; ++k)
        if (parents[k] != block.other) block.of_parents[k] = slot(parents[k], block.other);
    }
  }
}

SystemMatrix::Slot SystemMatrix::slot(VertexId a, VertexId b) const {
  const VertexId row = a > b ? a : b;
  const VertexId column = a > b ? b : a;
  const std::vector<VertexId>& rows = below_[column];
  const auto place = std::lower_bound(rows.begin(), rows.end(), row);
  return {row, column, static_cast<int>(place - rows.begin())};
}

bool SystemMatrix::joins(VertexId a, VertexId b) const {
  const std::vector<VertexId>& rows = below_[std::min(a.value, b.value)];
  return std::binary_search(rows.begin(), rows.end(), a > b ? a : b);
}

/// The three values of one column of a block lie side by side, behind the column's share of the
/// diagonal block.
double* SystemMatrix::block_column(const Slot& slot, int component) {
  const int column = 3 * slot.column + component;
  return matrix_.valuePtr() + matrix_.outerIndexPtr()[column] + (3 - component) + 3 * slot.rank;
}

void SystemMatrix::add_block(const Slot& slot, const Mat3& block) {
  for (int c = 0; c < 3; ++c) {
    double* values = block_column(slot, c);
    for (int r = 0; r < 3; ++r) values[r] += block(r, c);
  }
}

double SystemMatrix::diagonal_trace(VertexId vertex) const {
  double trace = 0;
  for (int c = 0; c < 3; ++c) trace += matrix_.valuePtr()[matrix_.outerIndexPtr()[3 * vertex + c]];
  return trace;
}

double SystemMatrix::diagonal_along(VertexId vertex, const Vec3& direction) const {
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    const double* values = matrix_.valuePtr() + matrix_.outerIndexPtr()[3 * vertex + c];
    for (int r = c; r < 3; ++r)
      sum += (r == c ? 1 : 2) * direction[r] * values[r - c] * direction[c];
  }
  return sum;
}

void SystemMatrix::add_diagonal(VertexId vertex, const Mat3& block) {
  for (int c = 0; c < 3; ++c) {
    double* values = matrix_.valuePtr() + matrix_.outerIndexPtr()[3 * vertex + c];
    for (int r = c; r < 3; ++r) values[r - c] += block(r, c);
  }
}

/// The block in the row of `row`, which is left zero.
Mat3 SystemMatrix::take_block(const Slot& slot, VertexId row) {
  Mat3 block;
  for (int c = 0; c < 3; ++c) {
    Eigen::Map<Vec3> values(block_column(slot, c));
    block.col(c) = values;
    values.setZero();
  }
  return slot.row == row ? block : Mat3(block.transpose());
}

/// The block on the diagonal, which is left the identity.
Mat3 SystemMatrix::take_diagonal(VertexId vertex) {
  Mat3 block;
  for (int c = 0; c < 3; ++c) {
    double* values = matrix_.valuePtr() + matrix_.outerIndexPtr()[3 * vertex + c];
    for (int r = c; r < 3; ++r) {
      block(r, c) = block(c, r) = values[r - c];
      values[r - c] = r == c ? 1 : 0;
    }
  }
  return block;
}

void SystemMatrix::add_multiple_of_identity(const Slot& slot, double factor) {
  for (int c = 0; c < 3; ++c) block_column(slot, c)[c] += factor;
}

void SystemMatrix::add_to_diagonal(VertexId vertex, double factor) {
  for (int c = 0; c < 3; ++c) matrix_.valuePtr()[matrix_.outerIndexPtr()[3 * vertex + c]] += factor;
}

/// Every call for a pair takes the next pair of `for_each_pair`.
class SystemMatrix::Blocks {
 public:
  explicit Blocks(SystemMatrix& matrix) : matrix_(matrix), next_(matrix.slots_.data()) {}

  /// The energy depends on x_a - x_b alone: the block on the diagonals of both, minus it between.
  void add_difference(VertexId a, VertexId b, const Mat3& block) {
    matrix_.add_diagonal(a, block);
    matrix_.add_diagonal(b, block);
    matrix_.add_block(*next_++, -block);
  }
  /// A pair that adds nothing at these positions.
  void skip_pair() { ++next_; }

  /// All blocks of an element, whose pairs come row by row.
  template <std::size_t n>
  void add_element(const std::array<VertexId, n>& vertices,
                   const Eigen::Matrix<double, 3 * n, 3 * n>& block) {
    for (std::size_t i = 0; i < n; ++i) {
      matrix_.add_diagonal(vertices[i], block.template block<3, 3>(3 * i, 3 * i));
      for (std::size_t j = i + 1; j < n; ++j) {
        const Mat3 pair = block.template block<3, 3>(3 * i, 3 * j);
        matrix_.add_block(*next_++, vertices[i] > vertices[j] ? pair : Mat3(pair.transpose()));
      }
    }
  }

  /// Multiples of the identity [N/m].
  void add_to_diagonal(VertexId vertex, double factor) { matrix_.add_to_diagonal(vertex, factor); }
  void add_to_pair(double factor) { matrix_.add_multiple_of_identity(*next_++, factor); }

 private:
  SystemMatrix& matrix_;
  const Slot* next_;
};

void SystemMatrix::set_values(const SparseMatrix& lower) {
  PLEAT_CHECK(lower.nonZeros() == matrix_.nonZeros(), "values come with the same pattern");
  matrix_.coeffs() = lower.coeffs();
}

void SystemMatrix::add_masses(double factor) {
  for (int j = 0; j < model_.n_vertices(); ++j)
    add_to_diagonal(VertexId(j), factor * model_.masses[j]);
}

void SystemMatrix::add_elasticity(const PositionsView& positions, double stiffness_factor,
                                  double damping_factor, ElementHessian hessian) {
  Blocks blocks(*this);
  const MatrixShares shares{stiffness_factor, damping_factor, hessian};
  for_each_element_kind(model_,
                        [&](const auto& kind) { kind.add_to_matrix(positions, shares, blocks); });
}

// With x_h = (y_p + y_q)/2 the block A_hj gives half of itself to (p, j) and (q, j), and as A_jh
// half to (j, p) and (j, q): both at once where j is p or q. A_hh gives a quarter to each of the
// four between p and q.
void SystemMatrix::reduce_to_parents(Eigen::Ref<Eigen::VectorXd> rhs) {
  for (const HangingBlocks& h : hanging_blocks_) {
    const auto& parents = h.hanging.parents;
    for (const HangingBlock& block : h.blocks) {
      const Mat3 half = take_block(block.own, h.hanging.vertex) / 2;
      for (std::size_t k = 0; k < 2; ++k) {
        if (parents[k] == block.other)
          add_diagonal(parents[k], half + half.transpose());
        else
          add_block(block.of_parents[k],
                    block.of_parents[k].row == parents[k] ? half : Mat3(half.transpose()));
      }
    }
    const Mat3 quarter = take_diagonal(h.hanging.vertex) / 4;
    for (const VertexId parent : parents) add_diagonal(parent, quarter);
    add_block(h.between_parents, quarter);
  }
  pull_to_parents(model_.hanging, Eigen::Map<Positions>(rhs.data(), 3, model_.n_vertices()));
}

void SystemMatrix::choose_prescribed(const std::vector<VertexId>& vertices) {
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

void SystemMatrix::prescribe(const PositionsView& values, Eigen::Ref<Eigen::VectorXd> rhs) {
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
      double* diagonal = matrix_.valuePtr() + matrix_.outerIndexPtr()[3 * v + c];
      for (int r = c; r < 3; ++r) diagonal[r - c] = r == c ? 1 : 0;
      rhs[3 * v + c] = values(c, static_cast<Eigen::Index>(k));
    }
  }
}

SparseMatrix stiffness_matrix(const ClothModel& model, const PositionsView& positions,
                              ElementHessian hessian) {
  SystemMatrix matrix(model);
  matrix.add_elasticity(positions, 1, 0, hessian);
  return matrix.lower();
}

SparseMatrix mass_matrix(const ClothModel& model) {
  const int n = 3 * model.n_vertices();
  SparseMatrix matrix(n, n);
  matrix.reserve(Eigen::VectorXi::Constant(n, 1));
  for (int i = 0; i < n; ++i) matrix.insert(i, i) = model.masses[i / 3];
  matrix.makeCompressed();
  return matrix;
}

}  // namespace pleat
