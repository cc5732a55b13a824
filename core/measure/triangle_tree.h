#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace pleat {

using Corners = std::array<Vec3, 3>;  ///< of a triangle [m]

std::vector<Corners> triangle_corners(std::span<const Triangle> triangles,
                                      const Eigen::Ref<const Positions>& positions);

/// The nearest point of a triangle, as the weights of its corners.
Vec3 nearest_weights(const Vec3& p, const Corners& corners);

/// A binary tree of boxes around triangles.
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

 private:
  static constexpr std::size_t kLeafSize = 4;

  struct Member {
    Corners corners;
    std::size_t triangle;
  };

  /// Children of node n are n + 1 and `second`; a leaf has none.
  struct Node {
    Eigen::AlignedBox3d box;
    std::size_t begin = 0;  // of its members
    std::size_t end = 0;
    std::size_t second = 0;

    bool is_leaf() const { return second == 0; }
  };

  void build(std::size_t begin, std::size_t end);
  void search(std::size_t index, const Vec3& p, double& nearest);

  std::vector<Member> members_;
  std::vector<Node> nodes_;
  std::size_t last_nearest_ = 0;  // member
};

}  // namespace pleat
