#pragma once

#include <memory>
#include <vector>

#include "core/linalg/aggregation/block_level.h"
#include "core/linalg/aggregation/coarsening.h"
#include "core/linalg/aggregation/dense_factor.h"
#include "core/linalg/block_matrix.h"

namespace pleat {

/// One cycle of multigrid by smoothed aggregation (coarsening.h) as an approximate inverse of a
/// symmetric positive definite A: symmetric and positive definite itself, up to single precision.
///
/// Each level is smoothed by a Gauss-Seidel sweep forward and one backward, before and after the
/// coarser ones, to which all but the finest go twice; the coarsest is solved.
class Multigrid {
 public:
  /// Takes the pattern; the order of its rows is that of all vectors.
  void analyze(const BlockMatrix& A);

  /// Sets the places of the vertices, in the matrix's order of unknowns [m]; without places the
  /// coarse levels know translations alone. Of effect in the next `compute`.
  void set_places(const BlockMatrix& A, const double* places);

  /// Takes the values.
  void compute(const BlockMatrix& A);

  /// z = M^-1 r, 3 n_rows each.
  /// size  of r, positive: what is divided out in single precision
  void apply(const double* r, double size, double* z);

  int n_levels() const { return 1 + static_cast<int>(coarse_.size()); }

 private:
  struct CoarseLevel {
    BlockLevel<kRigid> level;
    RigidMotions<kRigid> motions;
    Coarsening<kRigid> to_next;
  };

  void take_values(const BlockMatrix& A);
  void compute_coarsest();
  void solve_coarsest();
  /// Computes the solution of a level from its right-hand side, from zero.
  template <int B>
  void cycle(BlockLevel<B>& level, const Coarsening<B>& to_coarser, std::size_t coarser,
             int n_visits);

  BlockLevel<3> finest_;
  RigidMotions<3> finest_motions_;
  Coarsening<3> to_first_;
  std::vector<std::unique_ptr<CoarseLevel>> coarse_;
  DenseFactor coarsest_;
};

}  // namespace pleat
