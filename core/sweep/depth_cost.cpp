#include "core/sweep/depth_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/contact/signed_distance.h"
#include "core/run/part_timer.h"

namespace pleat {
namespace {

/// Places lie in the surface's box and this share of its sides around it.
constexpr double kAround = 0.25;
constexpr int kMostChecked = 500;

/// Solid angle of a triangle [sr]. Source: van Oosterom & Strackee, The solid angle of a plane
/// triangle, IEEE Trans. Biomedical Engineering 30(2), 1983.
double solid_angle(const Corners& corners, const Vec3& place) {
  const Vec3 a = corners[0] - place;
  const Vec3 b = corners[1] - place;
  const Vec3 c = corners[2] - place;
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)),
                        la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

void check(const std::vector<Corners>& corners, const Vec3& place, double distance,
           DepthCost& cost) {
  double nearest = std::numeric_limits<double>::infinity();
  double angle = 0;
  for (const Corners& c : corners) {
    const Vec3 weights = nearest_weights(place, c);
    const Vec3 foot = weights[0] * c[0] + weights[1] * c[1] + weights[2] * c[2];
    nearest = std::min(nearest, (place - foot).norm());
    angle += solid_angle(c, place);
  }
  ++cost.n_checked;
  cost.largest_error = std::max(cost.largest_error, std::abs(std::abs(distance) - nearest));
  const bool is_inside = angle > 2 * M_PI;  // 4 pi inside, 0 outside
  if (is_inside != (distance < 0)) ++cost.n_wrong_sides;
}

}  // namespace

DepthCost depth_cost(const Positions& places, const std::vector<Triangle>& triangles, int n_places,
                     std::uint64_t seed) {
  const Vec3 low = places.rowwise().minCoeff();
  const Vec3 size = places.rowwise().maxCoeff() - low;
  Random random(seed);
  Positions asked(3, n_places);
  for (int i = 0; i < n_places; ++i)
    for (int k = 0; k < 3; ++k)
      asked(k, i) = low[k] + size[k] * random.uniform(-kAround, 1 + kAround);
  Eigen::VectorXd distances(n_places);
  DepthCost cost;
  const Stopwatch watch;
  SignedDistance distance(places, triangles);
  cost.build_ms = 1e3 * watch.elapsed();
  for (int i = 0; i < n_places; ++i) distances[i] = distance.at(asked.col(i));
  cost.query_ms = 1e3 * watch.elapsed() - cost.build_ms;
  cost.bytes = distance.bytes();
  const std::vector<Corners> corners = triangle_corners(triangles, places);
  for (int i = 0; i < std::min(n_places, kMostChecked); ++i)
    check(corners, asked.col(i), distances[i], cost);
  return cost;
}

}  // namespace pleat
