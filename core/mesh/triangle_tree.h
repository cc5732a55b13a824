#pragma once

#include <vector>

#include "core/mesh/triangle_boxes.h"

namespace pleat {

/// The nearest point of a triangle, as the weights of its corners.
Vec3 nearest_weights(const Vec3& p, const Corners& corners);

/// Finds the nearest of many triangles.
class TriangleTree {
 public:
  /// triangles  at least one; those without area count as the points they are
  explicit TriangleTree(const std::vector<Corners>& triangles);

  struct Nearest {
    std::size_t triangle = 0;
    double distance_squared = 0;  ///< [m^2]
  };

  /// Quick when asked in an order in which each point is near the one before.
  Nearest nearest(const Vec3& p);

  /// Memory that it holds [bytes].
  std::size_t bytes() const { return boxes_.bytes() + corners_.capacity() * sizeof(Corners); }

 private:
  void search(std::size_t index, const Vec3& p, double& nearest);

  TriangleBoxes boxes_;
  std::vector<Corners> corners_;  // corners in the order of the boxes
  std::size_t last_nearest_ = 0;  // index in corners_
};

}  // namespace pleat
