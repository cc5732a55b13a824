#pragma once

#include <vector>

#include "core/dynamics/pbd/length_groups.h"
#include "core/multigrid/mesh_hierarchy.h"

namespace pleat {

/// How a cycle goes over each coarse level.
struct CycleSmoothing {
  Relaxation before;  ///< on the way to coarser levels
  Relaxation after;   ///< on the way back
};

/// The coarser levels of a hierarchy, as a correction of the finest one: places of the next finer
/// level are copied, projected, and the moves that this gave are handed back through the weights of
/// the transfer, so that detail stays.
///
/// A coarse vertex has the mass that the transfer hands to it, which keeps the momentum of every
/// correction. Source: Mueller, Hierarchical position based dynamics, VRIPHYS 2008;
/// docs/methods/multigrid.md.
///
/// Quad  Float4, or Double4 for tests
template <class Quad>
class CoarseLevels {
 public:
  using Real = typename Quad::Real;

  CoarseLevels() = default;
  /// places          of the finest level's vertices, in the arrays that `correct` takes
  /// inverse_masses  relative, of each vertex of the finest level; 0: it does not move
  CoarseLevels(const MeshHierarchy& hierarchy, const std::vector<int>& places,
               const std::vector<double>& inverse_masses, LevelLengths lengths);

  /// Corrects the moves of the finest level once. Arrays as of LengthGroups.
  void correct(const Real* begins, Real* moves, const CycleSmoothing& smoothing);

  int n_levels() const { return static_cast<int>(levels_.size()); }  ///< without the finest

 private:
  struct Level {
    std::vector<int> sources;  ///< first number of each vertex in the next finer level
    LengthGroups<Quad> lengths;
    std::vector<Real> begins, moves, corrections;
    /// Rows of the transfer to vertices of the finer level that move.
    std::vector<int> targets;  ///< their first numbers
    std::vector<int> row_ends;
    std::vector<int> columns;  ///< first number of the coarse vertex
    std::vector<Real> weights;
  };

  void correct_level(std::size_t k, const Real* begins, Real* moves,
                     const CycleSmoothing& smoothing);

  std::vector<Level> levels_;
};

extern template class CoarseLevels<Float4>;

}  // namespace pleat
