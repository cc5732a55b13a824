#include "core/refinement/bend_features.h"

#include <string>

#include "core/base/check.h"

namespace pleat {

BendFeatureSum::BendFeatureSum(const QuadMesh& mesh)
    : curvature_(mesh),
      mean_(Eigen::VectorXd::Zero(mesh.n_vertices())),
      squares_(Eigen::VectorXd::Zero(mesh.n_vertices())) {}

void BendFeatureSum::add(const PositionsView& positions) {
  const std::string frame = "frame " + std::to_string(n_frames_);
  if (positions.cols() != mean_.size())
    throw InputError(frame, "expected " + std::to_string(mean_.size()) +
                                " vertices as the mesh has, got " +
                                std::to_string(positions.cols()));
  for (Eigen::Index v = 0; v < positions.cols(); ++v)
    if (!positions.col(v).allFinite())
      throw InputError(frame, "expected finite positions, got none at vertex " + std::to_string(v));
  ++n_frames_;
  const Eigen::VectorXd curvature = curvature_.of(positions);
  const Eigen::VectorXd change = curvature - mean_;
  mean_ += change / n_frames_;
  squares_.array() += change.array() * (curvature - mean_).array();
}

BendFeatures BendFeatureSum::features() const {
  if (n_frames_ < 2)
    throw InputError("frames", "expected at least 2, got " + std::to_string(n_frames_));
  BendFeatures features(2, mean_.size());
  features.row(0) = mean_;
  features.row(1) = (squares_ / n_frames_).cwiseSqrt();
  return features;
}

}  // namespace pleat
