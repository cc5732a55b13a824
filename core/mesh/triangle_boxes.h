#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace pleat {

using Corners = std::array<Vec3, 3>;  ///< corners of a triangle [m]

std::vector<Corners> triangle_corners(std::span<const Triangle> triangles,
                                      const PositionsView& positions);

/// A binary tree of boxes around triangles that lie near one another.
class TriangleBoxes {
 public:
  /// Children of node n are n + 1 and `second`; a leaf has none.
  struct Node {
    Eigen::AlignedBox3d box;
    std::size_t begin = 0;  ///< first of its triangles in `order`
    std::size_t end = 0;
    std::size_t second = 0;

    bool is_leaf() const { return second == 0; }
  };

  /// triangles  at least one
  explicit TriangleBoxes(const std::vector<Corners>& triangles);

  /// The root is the first.
  const std::vector<Node>& nodes() const { return nodes_; }
  /// Every triangle once; those of a node stand together.
  const std::vector<std::size_t>& order() const { return order_; }

  /// Keeps the tree and fits its boxes to triangles that have moved, ordered as `order` has them.
  void fit(const std::vector<Corners>& ordered);

  /// Memory that it holds [bytes].
  std::size_t bytes() const {
    return order_.capacity() * sizeof(std::size_t) + nodes_.capacity() * sizeof(Node);
  }

 private:
  static constexpr std::size_t kLeafSize = 4;

  void split(const std::vector<Corners>& triangles, std::size_t begin, std::size_t end);

  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace pleat
