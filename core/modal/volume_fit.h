#pragma once

#include <memory>

#include "core/linalg/linear_solver.h"
#include "core/modal/carrying_volume.h"
#include "core/modal/tet_element.h"

namespace pleat {

/// Deforms a volume so that the surface it carries lies where it is wanted, and otherwise as
/// rigidly as possible: the least, over the volume's vertices, of
///
///     sum_t V_t min_R |F_t - R|^2  +  attachment V / n sum_v |s_v - wanted_v|^2
///
/// with the places s of the n surface vertices and the whole volume V at rest, by L-BFGS.
///
/// Source: Sorkine & Alexa, As-rigid-as-possible surface modeling, SGP 2007.
class VolumeFit {
 public:
  /// attachment  [1/m^2], positive
  /// Throws ContractError where a tetrahedron has no volume, or every vertex of the surface is 0
  /// in a part of the volume, which then could be anywhere.
  VolumeFit(const CarryingVolume& carrying, double attachment);

  /// wanted            of the surface [m]
  /// volume_positions  where to start from; becomes the deformed volume [m]
  ///
  /// Ends where all that a step gains is what the surface would have 1e-8 of its extent away, else
  /// reports not_converged with the places so far.
  SolveReport fit(const Positions& wanted, Positions& volume_positions) const;

 private:
  SparseMatrix embedding_;
  double pull_;  // weight of each surface vertex [m]
  std::vector<TetElement> elements_;
  std::unique_ptr<LinearSolver> solver_;
};

}  // namespace pleat
