#pragma once

#include <algorithm>
#include <vector>

#include "core/mesh/quad_mesh.h"

namespace pleat {

/// Losses of faces against shapes [m^4]: the rest area of each times the mean squared distance
/// between the shape's points on it and the face drawn from its corners, by area and over frames. A
/// column for each face of a uniform mesh, split or not.
///
/// A face shows the bilinear patch of its corners. Child k of a face may stand with its corners
/// k + 1 and k + 3 on edges of coarser faces; they hang then, and are drawn in the middle of the
/// edge. Rows: none hangs, k + 1 hangs, k + 3 hangs, both hang.
using FaceLosses = Eigen::Matrix<double, 4, Eigen::Dynamic>;

/// Gathers the losses of a motion frame by frame, without keeping the frames.
class FaceLossSum {
 public:
  /// fine  refined uniformly; shapes are known at its vertices, so that its own faces lose nothing
  ///       while no corner hangs
  explicit FaceLossSum(const QuadMesh& fine);

  /// positions  one column per vertex [m]; ContractError for another number
  void add(const PositionsView& positions);

  int n_frames() const { return n_frames_; }

  /// Means over the frames so far; zero without any.
  FaceLosses losses() const { return sums_ / std::max(1, n_frames_); }

 private:
  QuadMesh fine_;
  std::vector<std::vector<VertexId>> grids_;  // vertices of each face in rows from corner 0 to 1
  FaceLosses sums_;
  int n_frames_ = 0;
};

}  // namespace pleat
