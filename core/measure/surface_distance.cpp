#include "core/measure/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/check.h"

namespace pleat {
namespace {

constexpr double kPercentile = 0.95;
constexpr double kPointsPerTriangle = 4;  // of the finer mesh

using Corners = std::array<Vec3, 3>;

std::vector<Corners> corners_of(std::span<const Triangle> triangles,
                                const Eigen::Ref<const Positions>& positions) {
  std::vector<Corners> corners;
  corners.reserve(triangles.size());
  for (const Triangle& t : triangles)
    corners.push_back({positions.col(t[0]), positions.col(t[1]), positions.col(t[2])});
  return corners;
}

Vec3 doubled_area(const Corners& c) { return (c[1] - c[0]).cross(c[2] - c[0]); }

double area(const Corners& c) { return doubled_area(c).norm() / 2; }

double segment_distance_squared(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length_squared = ab.squaredNorm();
  const double share =
      length_squared > 0 ? std::clamp((p - a).dot(ab) / length_squared, 0.0, 1.0) : 0;
  return (p - a - share * ab).squaredNorm();
}

/// To the plane where the foot lies inside, else to the nearest edge.
double triangle_distance_squared(const Vec3& p, const Corners& c) {
  const Vec3 normal = doubled_area(c);
  const double normal_squared = normal.squaredNorm();
  bool is_inside = normal_squared > 0;
  for (int k = 0; k < 3 && is_inside; ++k)
    is_inside = (c[(k + 1) % 3] - c[k]).cross(p - c[k]).dot(normal) >= 0;
  if (is_inside) {
    const double height = (p - c[0]).dot(normal);
    return height * height / normal_squared;
  }
  return std::min({segment_distance_squared(p, c[0], c[1]), segment_distance_squared(p, c[1], c[2]),
                   segment_distance_squared(p, c[2], c[0])});
}

/// A binary tree of boxes around triangles.
class TriangleTree {
 public:
  explicit TriangleTree(std::vector<Corners> triangles) : triangles_(std::move(triangles)) {
    nodes_.reserve(2 * triangles_.size());
    build(0, triangles_.size());
  }

  /// Squared distance of the nearest triangle [m^2]; quick when asked in an order in which each
  /// point is near the one before.
  double distance_squared(const Vec3& p) {
    double nearest = triangle_distance_squared(p, triangles_[last_nearest_]);
    search(0, p, nearest);
    return nearest;
  }

 private:
  static constexpr std::size_t kLeafSize = 4;

  /// Children of node n are n + 1 and `second`; a leaf has none.
  struct Node {
    Eigen::AlignedBox3d box;
    std::size_t begin = 0;  // of its triangles
    std::size_t end = 0;
    std::size_t second = 0;

    bool is_leaf() const { return second == 0; }
  };

  /// Splits at the median of the centroids along the box's longest side.
  void build(std::size_t begin, std::size_t end) {
    const std::size_t index = nodes_.size();
    nodes_.push_back({{}, begin, end, 0});
    for (std::size_t t = begin; t < end; ++t)
      for (const Vec3& corner : triangles_[t]) nodes_[index].box.extend(corner);
    if (end - begin <= kLeafSize) return;
    Eigen::Index axis = 0;
    nodes_[index].box.sizes().maxCoeff(&axis);
    const std::size_t middle = (begin + end) / 2;
    const auto first = triangles_.begin();
    std::nth_element(
        first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(middle),
        first + static_cast<std::ptrdiff_t>(end), [axis](const Corners& a, const Corners& b) {
          return a[0][axis] + a[1][axis] + a[2][axis] < b[0][axis] + b[1][axis] + b[2][axis];
        });
    build(begin, middle);
    nodes_[index].second = nodes_.size();
    build(middle, end);
  }

  void search(std::size_t index, const Vec3& p, double& nearest) {
    const Node& node = nodes_[index];
    if (node.is_leaf()) {
      for (std::size_t t = node.begin; t < node.end; ++t) {
        const double distance = triangle_distance_squared(p, triangles_[t]);
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

  std::vector<Corners> triangles_;
  std::vector<Node> nodes_;
  std::size_t last_nearest_ = 0;
};

double total_area(const std::vector<Corners>& triangles) {
  double sum = 0;
  for (const Corners& c : triangles) sum += area(c);
  return sum;
}

struct WeightedDistance {
  double squared;  // [m^2]
  double weight;
};

/// Appends the distances from the m^2 centroids of a triangle's equal parts, strip by strip. Even
/// parts of a strip point as the triangle does, odd ones the other way.
void append_distances(const Corners& c, int m, double weight, TriangleTree& other,
                      std::vector<WeightedDistance>& distances) {
  for (int i = 0; i < m; ++i) {
    for (int part = 0; part < 2 * (m - i) - 1; ++part) {
      const double third = part % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
      const double across = (i + third) / m;
      const int place = part / 2;
      const double along = (place + third) / m;
      const Vec3 p = c[0] + across * (c[1] - c[0]) + along * (c[2] - c[0]);
      distances.push_back({other.distance_squared(p), weight / (m * m)});
    }
  }
}

/// The points of one surface, which have half of all weight.
void append_distances(const std::vector<Corners>& from, double n_points, TriangleTree& other,
                      std::vector<WeightedDistance>& distances) {
  const double total = total_area(from);
  for (const Corners& c : from) {
    const double share = total > 0 ? area(c) / total : 1 / static_cast<double>(from.size());
    const int m = static_cast<int>(std::ceil(std::sqrt(share * n_points)));
    append_distances(c, m, share / 2, other, distances);
  }
}

SurfaceError summary(std::vector<WeightedDistance> distances) {
  std::sort(distances.begin(), distances.end(),
            [](const auto& p, const auto& q) { return p.squared < q.squared; });
  double weight = 0;
  double sum = 0;
  for (const WeightedDistance& d : distances) {
    weight += d.weight;
    sum += d.weight * d.squared;
  }
  double nearer = 0;
  const auto at = std::find_if(distances.begin(), distances.end(), [&](const auto& d) {
    return (nearer += d.weight) >= kPercentile * weight;
  });
  return {std::sqrt(sum / weight), std::sqrt(at->squared), std::sqrt(distances.back().squared)};
}

}  // namespace

SurfaceError surface_error(std::span<const Triangle> triangles_a,
                           const Eigen::Ref<const Positions>& positions_a,
                           std::span<const Triangle> triangles_b,
                           const Eigen::Ref<const Positions>& positions_b) {
  PLEAT_CHECK(!triangles_a.empty() && !triangles_b.empty(), "a surface has a triangle");
  PLEAT_CHECK(positions_a.allFinite() && positions_b.allFinite(), "a surface is at finite places");
  const std::vector<Corners> a = corners_of(triangles_a, positions_a);
  const std::vector<Corners> b = corners_of(triangles_b, positions_b);
  const double n_points = kPointsPerTriangle * static_cast<double>(std::max(a.size(), b.size()));
  TriangleTree tree_a(a);
  TriangleTree tree_b(b);
  std::vector<WeightedDistance> distances;
  append_distances(a, n_points, tree_b, distances);
  append_distances(b, n_points, tree_a, distances);
  return summary(std::move(distances));
}

}  // namespace pleat
