#include "core/mesh/triangle_boxes.h"

#include <algorithm>
#include <numeric>

#include "core/base/check.h"

namespace pleat {

std::vector<Corners> triangle_corners(std::span<const Triangle> triangles,
                                      const PositionsView& positions) {
  std::vector<Corners> corners;
  corners.reserve(triangles.size());
  for (const Triangle& t : triangles)
    corners.push_back({positions.col(t[0]), positions.col(t[1]), positions.col(t[2])});
  return corners;
}

TriangleBoxes::TriangleBoxes(const std::vector<Corners>& triangles) : order_(triangles.size()) {
  PLEAT_CHECK(!triangles.empty(), "a tree has a triangle");
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  nodes_.reserve(2 * triangles.size());
  split(triangles, 0, triangles.size());
}

void TriangleBoxes::fit(const std::vector<Corners>& ordered) {
  PLEAT_CHECK(ordered.size() == order_.size(), "a tree keeps its triangles");
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    Node& node = nodes_[n];
    if (!node.is_leaf()) {
      node.box = nodes_[n + 1].box.merged(nodes_[node.second].box);
      continue;
    }
    node.box.setEmpty();
    for (std::size_t t = node.begin; t < node.end; ++t)
      for (const Vec3& corner : ordered[t]) node.box.extend(corner);
  }
}

/// Splits at the median of the centroids along the box's longest side.
void TriangleBoxes::split(const std::vector<Corners>& triangles, std::size_t begin,
                          std::size_t end) {
  const std::size_t index = nodes_.size();
  nodes_.push_back({{}, begin, end, 0});
  for (std::size_t t = begin; t < end; ++t)
    for (const Vec3& corner : triangles[order_[t]]) nodes_[index].box.extend(corner);
  if (end - begin <= kLeafSize) return;
  Eigen::Index axis = 0;
  nodes_[index].box.sizes().maxCoeff(&axis);
  const std::size_t middle = (begin + end) / 2;
  const auto first = order_.begin();
  const auto sum = [&triangles, axis](std::size_t t) {
    const Corners& c = triangles[t];
    return c[0][axis] + c[1][axis] + c[2][axis];
  };
  std::nth_element(first + static_cast<std::ptrdiff_t>(begin),
                   first + static_cast<std::ptrdiff_t>(middle),
                   first + static_cast<std::ptrdiff_t>(end),
                   [&sum](std::size_t a, std::size_t b) { return sum(a) < sum(b); });
  split(triangles, begin, middle);
  nodes_[index].second = nodes_.size();
  split(triangles, middle, end);
}

}  // namespace pleat
