#pragma once

#include <vector>

#include "core/dynamics/position_based/levels/length_groups.h"
#include "core/dynamics/position_based/levels/strain_rows.h"
#include "core/hierarchy/mesh_hierarchy.h"

namespace pleat {

/// How a cycle goes over each coarse level.
struct CycleSmoothing {
  Relaxation before;  ///< taken on the way to coarser levels
  Relaxation after;   ///< taken on the way back
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
  /// Levels whose lengths are what the next finer level's errors ask for.
  ///
  /// finest  the constraints of the finest mesh;  rest  its places at rest [m]
  CoarseLevels(const MeshHierarchy& hierarchy, const std::vector<int>& places,
               const std::vector<double>& inverse_masses, const StrainedEdges& finest,
               const Positions& rest);

  /// Corrects the moves of the finest level once. Arrays as of LengthGroups.
  ///
  /// strains  what is wrong with each of the finest constraints, relative to its length; where
  ///          levels ask for it
  /// growth   what all lengths are multiplied by
  void correct(const Real* begins, Real* moves, const CycleSmoothing& smoothing,
               const Real* strains = nullptr, Real growth = 1);

  /// Lengths that `correct` projects, each as often as it does.
  int n_projections(const CycleSmoothing& smoothing) const;
  int n_levels() const { return static_cast<int>(levels_.size()); }  ///< the finest apart

 private:
  struct Level {
    std::vector<int> sources;  ///< first number of each vertex in the next finer level
    LengthGroups<Quad> lengths;
    StrainRows from_finer;
    std::vector<Real> strains;
    std::vector<Real> begins, moves, corrections;
    /// Rows of the transfer to vertices of the finer level that move.
    std::vector<int> targets;  ///< their first numbers
    std::vector<int> row_ends;
    std::vector<int> columns;  ///< first number of the coarse vertex
    std::vector<Real> weights;
  };
  /// First numbers of a finer level's vertices, and their inverse masses.
  struct FinerLevel {
    std::vector<int> places;
    std::vector<double> inverse_masses;
  };

  static void take_rows(const Transfer& transfer, const FinerLevel& finer, Level& level);
  bool is_by_error() const { return !levels_.empty() && !levels_[0].strains.empty(); }
  /// Sweeps of a level on the way back.
  int n_sweeps(std::size_t k) const;
  void correct_level(std::size_t k, const Real* begins, Real* moves,
                     const CycleSmoothing& smoothing, const Real* strains, Real growth);

  std::vector<Level> levels_;
  Real share_ = 0;  // share of a correction that is handed back
};

extern template class CoarseLevels<Float4>;

}  // namespace pleat
