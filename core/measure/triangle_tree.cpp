#include "core/measure/triangle_tree.h"

#include <algorithm>
#include <utility>

#include "core/base/check.h"

namespace pleat {
namespace {

Vec3 doubled_area(const Corners& c) { return (c[1] - c[0]).cross(c[2] - c[0]); }

double segment_share(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length_squared = ab.squaredNorm();
  return length_squared > 0 ? std::clamp((p - a).dot(ab) / length_squared, 0.0, 1.0) : 0;
}

double segment_distance_squared(const Vec3& p, const Vec3& a, const Vec3& b) {
  return (p - a - segment_share(p, a, b) * (b - a)).squaredNorm();
}

/// True where the foot on the triangle's plane lies inside.
bool is_above(const Vec3& p, const Corners& c, const Vec3& normal) {
  for (int k = 0; k < 3; ++k)
    if ((c[(k + 1) % 3] - c[k]).cross(p - c[k]).dot(normal) < 0) return false;
  return normal.squaredNorm() > 0;
}

/// To the plane where the foot lies inside, else to the nearest edge.
double triangle_distance_squared(const Vec3& p, const Corners& c) {
  const Vec3 normal = doubled_area(c);
  if (is_above(p, c, normal)) {
    const double height = (p - c[0]).dot(normal);
    return height * height / normal.squaredNorm();
  }
  return std::min({segment_distance_squared(p, c[0], c[1]), segment_distance_squared(p, c[1], c[2]),
                   segment_distance_squared(p, c[2], c[0])});
}

}  // namespace

std::vector<Corners> triangle_corners(std::span<const Triangle> triangles,
                                      const Eigen::Ref<const Positions>& positions) {
  std::vector<Corners> corners;
  corners.reserve(triangles.size());
  for (const Triangle& t : triangles)
    corners.push_back({positions.col(t[0]), positions.col(t[1]), positions.col(t[2])});
  return corners;
}

Vec3 nearest_weights(const Vec3& p, const Corners& c) {
  const Vec3 normal = doubled_area(c);
  Vec3 weights = Vec3::Zero();
  if (is_above(p, c, normal)) {
    for (int k = 0; k < 3; ++k)
      weights[k] = (c[(k + 2) % 3] - c[(k + 1) % 3]).cross(p - c[(k + 1) % 3]).dot(normal) /
                   normal.squaredNorm();
    return weights;
  }
  int nearest = 0;
  double least = segment_distance_squared(p, c[0], c[1]);
  for (int k = 1; k < 3; ++k) {
    const double distance = segment_distance_squared(p, c[k], c[(k + 1) % 3]);
    if (distance < least) {
      least = distance;
      nearest = k;
    }
  }
  const double share = segment_share(p, c[nearest], c[(nearest + 1) % 3]);
  weights[nearest] = 1 - share;
  weights[(nearest + 1) % 3] = share;
  return weights;
}

TriangleTree::TriangleTree(const std::vector<Corners>& triangles) {
  PLEAT_CHECK(!triangles.empty(), "a tree has a triangle");
  members_.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) members_.push_back({triangles[t], t});
  nodes_.reserve(2 * triangles.size());
  build(0, members_.size());
}

TriangleTree::Nearest TriangleTree::nearest(const Vec3& p) {
  double least = triangle_distance_squared(p, members_[last_nearest_].corners);
  search(0, p, least);
  return {members_[last_nearest_].triangle, least};
}

/// Splits at the median of the centroids along the box's longest side.
void TriangleTree::build(std::size_t begin, std::size_t end) {
  const std::size_t index = nodes_.size();
  nodes_.push_back({{}, begin, end, 0});
  for (std::size_t t = begin; t < end; ++t)
    for (const Vec3& corner : members_[t].corners) nodes_[index].box.extend(corner);
  if (end - begin <= kLeafSize) return;
  Eigen::Index axis = 0;
  nodes_[index].box.sizes().maxCoeff(&axis);
  const std::size_t middle = (begin + end) / 2;
  const auto first = members_.begin();
  const auto sum = [axis](const Member& m) {
    return m.corners[0][axis] + m.corners[1][axis] + m.corners[2][axis];
  };
  std::nth_element(first + static_cast<std::ptrdiff_t>(begin),
                   first + static_cast<std::ptrdiff_t>(middle),
                   first + static_cast<std::ptrdiff_t>(end),
                   [&sum](const Member& a, const Member& b) { return sum(a) < sum(b); });
  build(begin, middle);
  nodes_[index].second = nodes_.size();
  build(middle, end);
}

void TriangleTree::search(std::size_t index, const Vec3& p, double& nearest) {
  const Node& node = nodes_[index];
  if (node.is_leaf()) {
    for (std::size_t t = node.begin; t < node.end; ++t) {
      const double distance = triangle_distance_squared(p, members_[t].corners);
      if (distance >= nearest) continue;
      nearest = distance;
      last_nearest_ = t;
    }
    return;
  }
  std::size_t first = index + 1;
  std::size_t second = node.second;
  double to_first = nodes_[first].box.squaredExteriorDistance(p);
  double to_second = nodes_[second].box.squaredExteriorDistance(p);
  if (to_second < to_first) {
    std::swap(first, second);
    std::swap(to_first, to_second);
  }
  if (to_first < nearest) search(first, p, nearest);
  if (to_second < nearest) search(second, p, nearest);
}

}  // namespace pleat
