#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/base/vec.h"
#include "core/linalg/sparse.h"

namespace pleat {

/// A symmetric 3n x 3n matrix with a 3x3 block for each vertex and for each of some pairs of
/// vertices. The pattern is built once; blocks are added straight into place.
class VertexMatrix {
 public:
  using Pair = std::array<VertexId, 2>;

  /// Where the block (row, column), row > column, lies: as the `rank`th block below the diagonal of
  /// its column.
  struct Slot {
    VertexId row, column;
    int rank = 0;
  };

  /// pairs  of different vertices, in any order and as often as they like
  VertexMatrix(int n_vertices, std::span<const Pair> pairs);

  /// Of one of the pairs.
  Slot slot(VertexId a, VertexId b) const;
  /// Of each pair, in order.
  std::vector<Slot> slots(std::span<const Pair> pairs) const;

  void set_zero() { matrix_.coeffs().setZero(); }
  /// Takes the values of a matrix with the same pattern.
  void set_values(const SparseMatrix& lower);

  void add_diagonal(VertexId vertex, const Mat3& block) {
    for (int c = 0; c < 3; ++c) {
      double* values = diagonal_column(vertex, c);
      for (int r = c; r < 3; ++r) values[r - c] += block(r, c);
    }
  }
  void add_block(const Slot& slot, const Mat3& block) {
    for (int c = 0; c < 3; ++c) {
      double* values = block_column(slot, c);
      for (int r = 0; r < 3; ++r) values[r] += block(r, c);
    }
  }
  /// The same with factor times the identity as the block.
  void add_to_diagonal(VertexId vertex, double factor) {
    for (int c = 0; c < 3; ++c) *diagonal_column(vertex, c) += factor;
  }
  void add_multiple_of_identity(const Slot& slot, double factor) {
    for (int c = 0; c < 3; ++c) block_column(slot, c)[c] += factor;
  }
  /// A symmetric block for n vertices. `slots` stands at those of its pairs, 01 02 .. 12 .., and
  /// is moved past them.
  template <std::size_t n>
  void add_element(const std::array<VertexId, n>& vertices, const Slot*& slots,
                   const Eigen::Matrix<double, 3 * n, 3 * n>& block) {
    for (std::size_t i = 0; i < n; ++i) {
      add_diagonal(vertices[i], block.template block<3, 3>(3 * i, 3 * i));
      for (std::size_t j = i + 1; j < n; ++j, ++slots) {
        const Mat3 pair = block.template block<3, 3>(3 * i, 3 * j);
        add_block(*slots, vertices[i] > vertices[j] ? pair : Mat3(pair.transpose()));
      }
    }
  }

  const SparseMatrix& lower() const { return matrix_; }

  /// Moves prescribed values of some vertices to the right-hand side: rows and columns of these
  /// vertices become those of the identity. Call `choose_prescribed` when the set changes,
  /// `prescribe` after each assembly.
  void choose_prescribed(const std::vector<VertexId>& vertices);
  /// values  one column per chosen vertex, in order; rhs  3n.
  void prescribe(const Eigen::Ref<const Positions>& values, Eigen::Ref<Eigen::VectorXd> rhs);

 private:
  struct PrescribedBlock {
    Slot slot;
    int row_index, column_index;  // into the prescribed values, or -1 when that vertex is free
  };

  double* diagonal_column(VertexId vertex, int component) {
    return matrix_.valuePtr() + matrix_.outerIndexPtr()[3 * vertex + component];
  }
  /// The three values of one column of a block lie side by side, behind the column's share of the
  /// diagonal block.
  double* block_column(const Slot& slot, int component) {
    return diagonal_column(slot.column, component) + (3 - component) + 3 * slot.rank;
  }

  std::vector<std::vector<VertexId>> below_;  // by column: rows of its blocks, ascending
  SparseMatrix matrix_;
  std::vector<VertexId> prescribed_;
  std::vector<PrescribedBlock> prescribed_blocks_;
};

}  // namespace pleat
