#pragma once

#include <memory>

#include "core/linalg/linear_solver.h"
#include "core/modal/arap_blend.h"
#include "core/modal/tet_element.h"

namespace pleat {

/// ARAP distances between shapes of a volume, with a rotation for each tetrahedron and all vertices
/// free: what `ReducedArap` leaves out is measured against it. Coordinates are positions [m].
class FullArap {
 public:
  /// Throws ContractError where a tetrahedron has no volume, or the volume falls into parts.
  explicit FullArap(const TetMesh& rest);

  double scale() const { return scale_; }  ///< three times the volume, as `middle_shape` takes it
  const std::vector<TetElement>& elements() const { return elements_; }

  /// Both shapes and this outlive it.
  std::unique_ptr<ArapBlend> blend(const Positions& a, const Positions& b) const;

 private:
  std::vector<TetElement> elements_;
  Eigen::VectorXd masses_;  // mass of each vertex; they sum to 1
  std::unique_ptr<LinearSolver> solver_;
  double scale_;
};

}  // namespace pleat
