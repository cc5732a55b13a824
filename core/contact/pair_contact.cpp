#include "core/contact/pair_contact.h"

#include <algorithm>
#include <limits>

#include "core/contact/closest_points.h"

namespace pleat {
namespace {

/// Edges more parallel than this do not push: their ends do.
constexpr double kLeastAngle = 0.05;

bool presses(const SurfacePair& pair, const Positions& x) {
  if (pair.kind == SurfacePair::Kind::vertex_face) return true;
  const Vec3 a = x.col(pair.vertices[1]) - x.col(pair.vertices[0]);
  const Vec3 b = x.col(pair.vertices[3]) - x.col(pair.vertices[2]);
  return a.cross(b).squaredNorm() > kLeastAngle * kLeastAngle * a.squaredNorm() * b.squaredNorm();
}

}  // namespace

std::optional<PairContact> pair_contact(const WatchedPair& pair, int number,
                                        const Positions& begins) {
  const SurfacePair& sides = pair.sides;
  if (!presses(sides, begins)) return {};
  const ClosestPoints closest =
      closest_points(pair_differences(sides, begins), sides.n_differences());
  PairContact contact;
  contact.gap = closest.difference.norm();
  if (!(contact.gap > 0)) return {};
  contact.pair = number;
  contact.normal = closest.difference / contact.gap;
  contact.weights = closest.weights;
  for (int k = 0; k < sides.n_first(); ++k) contact.weights[static_cast<std::size_t>(k)] *= -1;
  contact.wanted = std::min(pair.gap, contact.gap);
  return contact;
}

double least_gap(const SurfacePair& pair, const Vec3& normal, const Positions& places) {
  double least = std::numeric_limits<double>::infinity();
  for (int a = 0; a < pair.n_first(); ++a)
    for (int b = pair.n_first(); b < 4; ++b)
      least = std::min(least, normal.dot(places.col(pair.vertices[static_cast<std::size_t>(b)]) -
                                         places.col(pair.vertices[static_cast<std::size_t>(a)])));
  return least;
}

}  // namespace pleat
