#pragma once

#include <vector>

#include "core/linalg/aggregation/aggregation.h"
#include "core/linalg/aggregation/block_level.h"

namespace pleat {

/// How many numbers a coarse row has: three translations and three rotations of a group.
inline constexpr int kRigid = 6;

/// Rigid motions of space in the unknowns of a level's rows.
template <int B>
struct RigidMotions {
  /// Place of each row in space, three numbers [m]. Empty: rotations are not known.
  std::vector<double> places;
  /// Motions of each row, B x 6 by rows: translations along the axes, rotations about its place.
  std::vector<double> motions;
};

/// Coarsens rows to their groups, each with six unknowns: smoothed aggregation.
///
/// The columns of T are the rigid motions of each group, orthonormal; P = (I - w A) C'T lets
/// them fade into the neighbourhood, in the scaled unknowns of the fine level (block_level.h), and
/// the coarse matrix is P'A P. Rows that are coupled to no
/// other, as pinned ones are, have no part in T and P: the smoother solves them. Motions that
/// depend on the others, as of a single vertex or a straight row, have columns of zeros in P and
/// ones on the diagonal of the coarse matrix.
///
/// Sources: Vanek, Mandel & Brezina, Computing 56, 1996; Tamstorf, Jones & McCormick, Smoothed
/// aggregation multigrid for cloth simulation, SIGGRAPH Asia 2015.
template <int B>
class Coarsening {
 public:
  /// Takes groups of a level's rows and gives the coarse level its pattern.
  void analyze(const BlockLevel<B>& fine, const Aggregates& groups, BlockLevel<kRigid>& coarse);

  /// Takes the values of the fine level, which are scaled, gives the coarse one its values and
  /// rigid motions, and scales it.
  void compute(const BlockLevel<B>& fine, const RigidMotions<B>& fine_motions,
               BlockLevel<kRigid>& coarse, RigidMotions<kRigid>& coarse_motions);

  /// b = P'r, in scaled unknowns of both levels.
  void restrict_to(const float* r, float* b) const;
  /// x += P e, in scaled unknowns of both levels.
  void add_prolonged(const float* e, float* x) const;

  /// C'T and P, dense blocks: B x 6 by rows. For tests.
  const double* tentative(int row) const { return tentative_.data() + row * kSize; }
  const double* block(int k) const { return exact_.data() + k * kSize; }
  int begin(int row) const { return begins_[static_cast<std::size_t>(row)]; }
  int column(int k) const { return columns_[static_cast<std::size_t>(k)]; }

 private:
  static constexpr int kSize = B * kRigid;

  template <class Work>
  void for_each_block(const BlockLevel<B>& fine, int row, const Work& work) const;
  void find_tentative(const BlockLevel<B>& fine, const RigidMotions<B>& fine_motions,
                      RigidMotions<kRigid>& coarse_motions);
  void orthonormalise(int group, RigidMotions<kRigid>& coarse_motions);
  void smooth_tentative(const BlockLevel<B>& fine);
  void multiply_out(const BlockLevel<B>& fine, BlockLevel<kRigid>& coarse);
  void scale_coarse(const BlockLevel<kRigid>& coarse);
  const float* scaled_block(int k) const { return values_.data() + k * kSize; }

  int n_groups_ = 0;
  std::vector<int> groups_;                            // group of each row, or -1
  std::vector<int> member_begins_, members_;           // rows of each group
  std::vector<int> begins_, columns_;                  // groups of P's rows, ascending
  std::vector<int> product_begins_, product_columns_;  // groups of A P's rows
  std::vector<int> targets_;       // places in the coarse values, in the order of multiply_out
  std::vector<double> tentative_;  // C'T, B x 6 for each row
  std::vector<double> exact_;      // P, to the coarse unknowns as they are
  std::vector<float> values_;      // P, to scaled ones, and room to load beyond its end
  std::vector<double> products_;   // one row of A P
  std::vector<int> slots_;         // place of each group in the row that is worked at
};

extern template class Coarsening<3>;
extern template class Coarsening<kRigid>;

}  // namespace pleat
