#include "core/contact/separator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/contact/closest_points.h"

namespace pleat {
namespace {

using Differences = std::array<Vec3, 4>;

/// Bound of what rounding adds to n.d, relative to the sum of |n_k d_k| [1]: 8 u. Ends need 5 u,
/// eighths of a way 7 u with the largest |d_k| of the whole way.
constexpr double kSumRounding = 0x1p-50;

/// Bound of what underflow adds to n.d [m]. Nearer sides are taken as touching.
constexpr double kSmallest = 1e-300;

/// The most corners that the search of a hull's least point goes to. Few take more than 6.
constexpr int kMostCorners = 16;

/// True where n.d is surely positive; a comparison with what is not a number is false.
bool is_ahead(const Vec3& n, const Vec3& d, const Vec3& sizes) {
  const double along = n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
  const double sum =
      std::abs(n[0] * sizes[0]) + std::abs(n[1] * sizes[1]) + std::abs(n[2] * sizes[2]);
  return along > kSumRounding * sum + kSmallest;
}

/// Larger of each component's sizes at both ends [m].
Differences sizes_of(const PairWay& way) {
  Differences sizes;
  for (int k = 0; k < way.count; ++k)
    sizes[k] = way.begins[k].cwiseAbs().cwiseMax(way.ends[k].cwiseAbs());
  return sizes;
}

/// sizes  of the whole way that this is a part of [m]
bool separates_part(const Vec3& n, const PairWay& part, const Differences& sizes) {
  for (int k = 0; k < part.count; ++k)
    if (!is_ahead(n, part.begins[k], sizes[k]) || !is_ahead(n, part.ends[k], sizes[k]))
      return false;
  return true;
}

/// Largest component 1, so that products do not vanish; not a number where n is zero.
Vec3 scaled(const Vec3& n) { return n / n.cwiseAbs().maxCoeff(); }

/// Hull of the differences at both ends, each a corner.
struct Hull {
  const PairWay& part;

  const Vec3& corner(int k) const {
    return k < part.count ? part.begins[k] : part.ends[k - part.count];
  }
  /// Corner that is least along n.
  int least_along(const Vec3& n) const {
    int lowest = 0;
    double height = n.dot(corner(0));
    for (int k = 1; k < 2 * part.count; ++k) {
      const double along = n.dot(corner(k));
      if (!(along < height)) continue;
      lowest = k;
      height = along;
    }
    return lowest;
  }
};

/// Up to three corners of a hull, and the point of least norm between them.
struct Facet {
  std::array<int, 3> corners{};
  int count = 0;
  Vec3 nearest{0, 0, 0};
};

/// Nearest facet with this corner and up to two of the given facet's, less those of weight zero.
Facet nearest_with(const Hull& hull, const Facet& facet, int corner) {
  Facet best;
  double least = std::numeric_limits<double>::infinity();
  const int n_sides = facet.count < 3 ? 1 : 3;
  for (int side = 0; side < n_sides; ++side) {
    const std::array<int, 3> corners{corner, facet.corners[side], facet.corners[(side + 1) % 3]};
    const ClosestPoints closest = closest_points(
        {hull.corner(corners[0]), hull.corner(corners[1]), hull.corner(corners[2]), Vec3::Zero()},
        3);
    const double square = closest.difference.squaredNorm();
    if (!(square < least)) continue;
    least = square;
    best = {{corner, corner, corner}, 0, closest.difference};
    for (int k = 0; k < 3; ++k)
      if (closest.weights[k + 1] > 0) best.corners[best.count++] = corners[k];
  }
  return best;
}

// Any n with n.d > 0 at all corners separates, and the hull's point of least norm is one where
// there is any. Corners are added that are least along the nearest point found so far, until that
// separates or comes no nearer: then the hull holds the origin, but for rounding.
std::optional<Vec3> hull_normal(const PairWay& part, const Differences& sizes, const Vec3& start) {
  const Hull hull{part};
  const int first = hull.least_along(start);
  Facet facet{{first, first, first}, 1, hull.corner(first)};
  for (int k = 0; k < kMostCorners; ++k) {
    const Vec3 n = scaled(facet.nearest);
    if (separates_part(n, part, sizes)) return n;
    const Facet next = nearest_with(hull, facet, hull.least_along(n));
    if (!(next.nearest.squaredNorm() < facet.nearest.squaredNorm())) break;
    facet = next;
  }
  return std::nullopt;
}

/// sizes  of the whole way [m]
std::optional<Vec3> part_separator(const PairWay& part, const Differences& sizes, int most_parts) {
  const Vec3 at_begin = scaled(closest_points(part.begins, part.count).difference);
  if (separates_part(at_begin, part, sizes)) return at_begin;
  const Vec3 at_end = scaled(closest_points(part.ends, part.count).difference);
  if (separates_part(at_end, part, sizes)) return at_end;
  if (auto normal = hull_normal(part, sizes, at_begin)) return normal;
  if (most_parts < 2) return std::nullopt;

  PairWay half = part;
  for (int k = 0; k < part.count; ++k) half.ends[k] = 0.5 * (part.begins[k] + part.ends[k]);
  if (!part_separator(half, sizes, most_parts / 2)) return std::nullopt;
  half.begins = half.ends;
  half.ends = part.ends;
  return part_separator(half, sizes, most_parts / 2);
}

}  // namespace

PairWay pair_way(const SurfacePair& pair, const PositionsView& begin, const PositionsView& end) {
  return {pair_differences(pair, begin), pair_differences(pair, end), pair.n_differences()};
}

bool separates(const Vec3& n, const PairWay& way) {
  for (int k = 0; k < way.count; ++k)
    if (!is_ahead(n, way.begins[k], way.begins[k]) || !is_ahead(n, way.ends[k], way.ends[k]))
      return false;
  return true;
}

std::optional<Vec3> separator(const PairWay& way, const Vec3& hint, int most_parts) {
  const Vec3 old = scaled(hint);
  if (separates(old, way)) return old;
  return part_separator(way, sizes_of(way), std::min(most_parts, kMostParts));
}

}  // namespace pleat
