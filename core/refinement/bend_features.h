#pragma once

#include "core/refinement/vertex_curvature.h"

namespace pleat {

/// Mean and standard deviation of each vertex's curvature over the frames of a motion [1/m], a
/// column per vertex.
using BendFeatures = Eigen::Matrix<double, 2, Eigen::Dynamic>;

/// Gathers the features of a motion, without keeping its frames. Source: Welford, Note on a method
/// for calculating corrected sums of squares and products, Technometrics 4(3), 1962.
class BendFeatureSum {
 public:
  explicit BendFeatureSum(const QuadMesh& mesh);

  /// positions  [m]. Throws InputError naming the frame (counted from 0) when it has another number
  /// of vertices than the mesh or one is not finite.
  void add(const PositionsView& positions);

  int n_frames() const { return n_frames_; }

  /// Throws InputError when there were fewer than two frames.
  BendFeatures features() const;

 private:
  VertexCurvature curvature_;
  int n_frames_ = 0;
  Eigen::VectorXd mean_;     // [1/m]
  Eigen::VectorXd squares_;  // summed squares of the distances from the mean [1/m^2]
};

}  // namespace pleat
