#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/fabric/curvature_stencil.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// How differently two states of one cloth are bent [1/m].
struct BendError {
  double distribution = 0;  ///< Wasserstein-1 distance between the distributions of curvature
  double regions = 0;       ///< mean difference between the mean curvatures of regions
};

/// Compares how states of one cloth are bent: how much of it is curved how strongly, wherever.
///
/// Both states are given at the vertices of one mesh, the finer one (carried_positions,
/// subdivided_positions), and smoothed over the edges of the coarsest one, since what lies between
/// its vertices would else look like error. The magnitude of curvature is
/// sqrt(|k_ww|^2 + |k_ff|^2 + 2 |k_wf|^2), by area at rest.
class BendMeasure {
 public:
  /// mesh    the finer mesh, its warp directions given
  /// radius  of the smoothing: an edge of the coarsest mesh compared [m], positive
  ///
  /// Keeps 16 bytes for each pair of triangles within the radius.
  BendMeasure(const TriangleMesh& mesh, double radius);

  /// positions  [m], of all vertices of the mesh
  /// Throws ContractError unless both are finite.
  BendError error(const PositionsView& positions, const PositionsView& reference) const;

  /// Smoothed magnitude of curvature of each triangle [1/m].
  Eigen::VectorXd curvatures(const PositionsView& positions) const;

  const Eigen::VectorXd& areas() const { return areas_; }  ///< rest area of each triangle [m^2]

 private:
  struct Neighbour {
    std::int32_t triangle;
    double weight;
  };

  std::vector<CurvatureStencil> stencils_;
  Eigen::VectorXd areas_;
  std::vector<Neighbour> neighbours_;  // one triangle's after the other's; its weights sum to one
  std::vector<std::size_t> ends_;      // end of each triangle's neighbours
  std::vector<int> regions_;           // region of each triangle
  int n_regions_ = 0;
};

/// Wasserstein-1 distance between two distributions of values, each with the same weights: how far
/// weight must be moved, over all weight; in the values' unit.
///
/// Throws ContractError unless the sizes agree and the weights are not negative, with a positive
/// sum.
double wasserstein_distance(const VectorView& values_a, const VectorView& values_b,
                            const VectorView& weights);

/// Positions of a mesh after `subdivided`: new vertices lie in the middle of the edges split.
Positions subdivided_positions(const PositionsView& positions,
                               std::span<const std::array<VertexId, 2>> middles);

}  // namespace pleat
