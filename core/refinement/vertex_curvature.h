#pragma once

#include <vector>

#include "core/mesh/quad_mesh.h"

namespace pleat {

/// Curvature [1/m] of the arc whose ends are `chord` [m] apart; 0 from chord = length on.
///
/// chord   not negative
/// length  of the arc [m], positive; ContractError for others
///
/// The relative error is at most 1e-10 for a given chord / length from 0.05 to 1 - 1e-12.
double arc_curvature(double chord, double length);

/// How far cloth bends at each vertex of a mesh [1/m]: the mean over the up to eight vertices two
/// steps away along warp, weft and both diagonals, the cloth between taken for an arc that keeps
/// its length. A hanging vertex has the mean of its parents, one without such neighbours 0.
///
/// Source: the multi-resolution quad cloth listed as M in docs/reproduction.md;
/// docs/methods/multiresolution.md.
class VertexCurvature {
 public:
  explicit VertexCurvature(const QuadMesh& mesh);

  /// positions  one column per vertex [m]; ContractError for another number.
  Eigen::VectorXd of(const PositionsView& positions) const;

  int n_vertices() const { return static_cast<int>(shares_.size()); }

 private:
  struct Arc {
    VertexId a, b;
    double length = 0;  // length of cloth between them [m]
  };

  std::vector<Arc> arcs_;
  Eigen::VectorXd shares_;  // one over the number of arcs that end at each vertex
  std::vector<HangingVertex> hanging_;
};

}  // namespace pleat
