#pragma once

#include <memory>

#include "core/modal/arap_blend.h"

namespace pleat {

/// ARAP distances between shapes of a space, with a rotation for each cluster of tetrahedra. What
/// depends on the mesh is summed up once; a blend costs the same however fine the mesh is.
///
/// Source: Jacobson et al., Fast automatic skinning transformations, ACM Transactions on Graphics
/// 31, 2012 (clusters of rotations); the space's own functions take the place of its weights.
class ReducedArap {
 public:
  /// cluster_of_tet  from 0, without gaps
  ReducedArap(const TetMesh& rest, const ShapeSpace& space, const std::vector<int>& cluster_of_tet);

  int n_clusters() const { return static_cast<int>(stiffnesses_.size()); }
  double scale() const { return scale_; }  ///< three times the volume, as `middle_shape` takes it

  /// A shape that others are compared with.
  struct Key {
    ShapeCoordinates shape;
    Eigen::MatrixXd pulls;  ///< k x 3 clusters: the stiffness of each times the shape
    double square;          ///< square of the shape in the stiffness of all
  };
  Key key(const ShapeCoordinates& shape) const;

  /// Both keys and this outlive it.
  std::unique_ptr<ArapBlend> blend(const Key& a, const Key& b) const;

  /// Key turned as a whole.
  static Key turned(const Key& key, const Mat3& rotation);

  /// How each cluster turned from a key to a shape.
  static std::vector<Mat3> rotations(const Key& from, const ShapeCoordinates& to);

 private:
  std::vector<Eigen::MatrixXd> stiffnesses_;  // stiffness of each cluster, k x k
  Eigen::MatrixXd stiffness_;                 // stiffness of all
  Eigen::MatrixXd compliance_;                // its inverse beside the constant function
  double scale_;
};

}  // namespace pleat
