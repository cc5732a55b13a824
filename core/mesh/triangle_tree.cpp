#include "core/mesh/triangle_tree.h"

#include <algorithm>
#include <utility>

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

/// Measured to the plane where the foot lies inside, else to the nearest edge.
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

TriangleTree::TriangleTree(const std::vector<Corners>& triangles) : boxes_(triangles) {
  corners_.reserve(triangles.size());
  for (const std::size_t t : boxes_.order()) corners_.push_back(triangles[t]);
}

TriangleTree::Nearest TriangleTree::nearest(const Vec3& p) {
  double least = triangle_distance_squared(p, corners_[last_nearest_]);
  search(0, p, least);
  return {boxes_.order()[last_nearest_], least};
}

void TriangleTree::search(std::size_t index, const Vec3& p, double& nearest) {
  const std::vector<TriangleBoxes::Node>& nodes = boxes_.nodes();
  const TriangleBoxes::Node& node = nodes[index];
  if (node.is_leaf()) {
    for (std::size_t t = node.begin; t < node.end; ++t) {
      const double distance = triangle_distance_squared(p, corners_[t]);
      if (distance >= nearest) continue;
      nearest = distance;
      last_nearest_ = t;
    }
    return;
  }
  std::size_t first = index + 1;
  std::size_t second = node.second;
  double to_first = nodes[first].box.squaredExteriorDistance(p);
  double to_second = nodes[second].box.squaredExteriorDistance(p);
  if (to_second < to_first) {
    std::swap(first, second);
    std::swap(to_first, to_second);
  }
  if (to_first < nearest) search(first, p, nearest);
  if (to_second < nearest) search(second, p, nearest);
}

}  // namespace pleat
