#include "core/error/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/check.h"
#include "core/mesh/triangle_tree.h"

namespace pleat {
namespace {

constexpr double kPercentile = 0.95;
constexpr double kPointsPerTriangle = 4;  // points per triangle of the finer mesh

double area(const Corners& c) { return (c[1] - c[0]).cross(c[2] - c[0]).norm() / 2; }

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
      distances.push_back({other.nearest(p).distance_squared, weight / (m * m)});
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

SurfaceError surface_error(std::span<const Triangle> triangles_a, const PositionsView& positions_a,
                           std::span<const Triangle> triangles_b,
                           const PositionsView& positions_b) {
  PLEAT_CHECK(!triangles_a.empty() && !triangles_b.empty(), "a surface has a triangle");
  PLEAT_CHECK(positions_a.allFinite() && positions_b.allFinite(), "a surface is at finite places");
  const std::vector<Corners> a = triangle_corners(triangles_a, positions_a);
  const std::vector<Corners> b = triangle_corners(triangles_b, positions_b);
  const double n_points = kPointsPerTriangle * static_cast<double>(std::max(a.size(), b.size()));
  TriangleTree tree_a(a);
  TriangleTree tree_b(b);
  std::vector<WeightedDistance> distances;
  append_distances(a, n_points, tree_b, distances);
  append_distances(b, n_points, tree_a, distances);
  return summary(std::move(distances));
}

}  // namespace pleat
