#pragma once

#include <algorithm>
#include <vector>

#include "core/error/material_map.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// How many folds around a garment are told apart: fewer are its stance, more are finer than coarse
/// meshes.
constexpr int kFewestFolds = 3;
constexpr int kMostFolds = 20;

/// How far folds stand out, for each number of them around a ring from kFewestFolds to kMostFolds
/// [m].
using FoldAmplitudes = Eigen::Matrix<double, kMostFolds - kFewestFolds + 1, 1>;

/// The amplitudes of a ring's distance from its axis, along the directions in which its first
/// harmonic, an ellipse, goes round.
///
/// ring  closed, points at equal steps along the cloth at rest [m], more than 2 kMostFolds;
///       ContractError for fewer
FoldAmplitudes fold_amplitudes(const PositionsView& ring);

/// Rings around cloth at rest: where a horizontal plane (y up) cuts it in closed lines, each of
/// `n_points` at equal steps along it [m]. Trousers have one for each leg.
std::vector<Positions> rest_rings(const TriangleMesh& mesh, double height, int n_points);

/// The rings that garments are compared by: at half and three quarters of the way down, and at the
/// hem.
std::vector<Positions> garment_rings(const TriangleMesh& mesh);

/// Gathers the folds of runs on one mesh.
class FoldSpectrum {
 public:
  /// mesh   at rest, whose positions are added
  /// rings  of the same cloth at rest, on whichever mesh
  FoldSpectrum(const TriangleMesh& mesh, const std::vector<Positions>& rings);

  void add(const PositionsView& positions);

  /// Root mean square over what was added, a column for each ring [m].
  Eigen::MatrixXd amplitudes() const { return (squares_ / std::max(1, n_added_)).cwiseSqrt(); }

 private:
  std::vector<MaterialMap> maps_;
  Eigen::MatrixXd squares_;  // summed [m^2]
  int n_added_ = 0;
};

/// How differently two runs of a cloth are folded [m]: of the differences of amplitudes the root of
/// the sum of squares over the numbers of folds, root mean square over the rings.
double fold_distance(const Eigen::Ref<const Eigen::MatrixXd>& amplitudes_a,
                     const Eigen::Ref<const Eigen::MatrixXd>& amplitudes_b);

}  // namespace pleat
