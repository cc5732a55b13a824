#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/linalg/sparse.h"
#include "core/model/elements.h"

namespace pleat {

/// A symmetric 3n x 3n matrix with a 3x3 block for every pair of vertices that an element of a
/// model joins. The pattern is built once; values are added element by element straight into place.
/// With hanging vertices it is A_x, as if they moved freely, until it is reduced.
class SystemMatrix {
 public:
  /// model  outlives the matrix and keeps its elements.
  explicit SystemMatrix(const ClothModel& model);

  /// Makes the pattern anew, with a block between these vertices too, of which none hang. Values
  /// are zero then, and prescribed vertices have to be chosen again.
  void join(std::span<const std::array<VertexId, 2>> joins);

  void set_zero() { matrix_.coeffs().setZero(); }
  /// Takes the values of a matrix with the same pattern.
  void set_values(const SparseMatrix& lower);
  /// Adds factor * m to the diagonal of each vertex.
  void add_masses(double factor);
  /// Adds stiffness_factor * K + damping_factor * C at these positions: K = -d(elastic force)/dx
  /// [N/m], C = -d(damping force)/dv [N s/m].
  void add_elasticity(const PositionsView& positions, double stiffness_factor,
                      double damping_factor, ElementHessian hessian);
  /// The trace of a vertex's block on the diagonal.
  double diagonal_trace(VertexId vertex) const;
  /// A vertex's resistance along a unit vector: that entry of its block on the diagonal.
  double diagonal_along(VertexId vertex, const Vec3& direction) const;
  /// Adds a block to the diagonal.
  void add_diagonal(VertexId vertex, const Mat3& block);
  /// True where there is a block between two vertices.
  bool joins(VertexId a, VertexId b) const;
  /// Adds a symmetric block between two vertices that it joins, either way round.
  void add_between(VertexId a, VertexId b, const Mat3& block) { add_block(slot(a, b), block); }

  const SparseMatrix& lower() const { return matrix_; }

  /// Makes A x = rhs, over all vertices, S^T A S y = S^T rhs, over those that do not hang: blocks
  /// of hanging vertices are shared among their parents', their own rows and columns become those
  /// of the identity, with right-hand sides of zero. Call it after each assembly, before
  /// `prescribe`.
  void reduce_to_parents(Eigen::Ref<Eigen::VectorXd> rhs);

  /// Moves prescribed values of some vertices to the right-hand side: rows and columns of these
  /// vertices become those of the identity. Call `choose_prescribed` when the set changes,
  /// `prescribe` after each assembly.
  void choose_prescribed(const std::vector<VertexId>& vertices);
  /// values  one column per chosen vertex, in order; rhs  3n.
  void prescribe(const PositionsView& values, Eigen::Ref<Eigen::VectorXd> rhs);

 private:
  /// The place of the block (row, column), row > column: it is the `rank`th below the diagonal of
  /// its column.
  struct Slot {
    VertexId row, column;
    int rank = 0;
  };
  struct PrescribedBlock {
    Slot slot;
    int row_index, column_index;  // indices of the prescribed values, -1 for a free vertex
  };

  /// The block that a hanging vertex shares with another, and those that its parents share with
  /// that one; unused where it is the parent itself.
  struct HangingBlock {
    VertexId other;
    Slot own;
    std::array<Slot, 2> of_parents;
  };
  struct HangingBlocks {
    HangingVertex hanging;
    std::vector<HangingBlock> blocks;
    Slot between_parents;
  };

  /// Puts the blocks of each kind of element into their slots.
  class Blocks;

  void join_parents();
  void find_hanging_slots();
  Mat3 take_block(const Slot& slot, VertexId row);
  Mat3 take_diagonal(VertexId vertex);
  Slot slot(VertexId a, VertexId b) const;
  double* block_column(const Slot& slot, int component);
  void add_block(const Slot& slot, const Mat3& block);
  void add_multiple_of_identity(const Slot& slot, double factor);
  void add_to_diagonal(VertexId vertex, double factor);

  const ClothModel& model_;
  std::vector<std::vector<VertexId>> below_;  // rows of the blocks in each column, ascending
  SparseMatrix matrix_;
  std::vector<Slot> slots_;  // one for each pair that an element joins, in the order of assembly
  std::vector<HangingBlocks> hanging_blocks_;  // blocks in the order of their elimination
  std::vector<VertexId> prescribed_;
  std::vector<PrescribedBlock> prescribed_blocks_;
};

/// K = -d(elastic force)/dx at these positions, lower triangle, 3n x 3n [N/m].
SparseMatrix stiffness_matrix(const ClothModel& model, const PositionsView& positions,
                              ElementHessian hessian);

/// M, lumped, 3n x 3n [kg].
SparseMatrix mass_matrix(const ClothModel& model);

}  // namespace pleat
