#include "core/contact/closest_points.h"

#include <algorithm>
#include <limits>

namespace pleat {
namespace {

/// Sine between two sides of a plane figure below which it is taken as its border [1]. A figure of
/// length 1 is as wide as the sine s, and rounding turns its normal by 1e-16/s: either errs by
/// 1e-8 here, and by more on the wrong side.
constexpr double kSideBySide = 1e-8;

/// Square below which a length counts as zero [m^2], and that of a normal [m^4]: its reciprocal
/// would lose digits.
constexpr double kLeastSquare = 1e-280;

/// Point p + v f + w g of least norm in the plane of two vectors.
struct PlanePoint {
  bool is_known = false;  ///< false where f and g span no plane
  double v = 0, w = 0;
  Vec3 difference{0, 0, 0};
};

// Point of the plane p + v f + w g that is nearest to the origin. It lies along n = f x g; its
// products with g x n and f x n, which are across n, are therefore zero:
//   v = -p.(g x n)/n.n,   w = p.(f x n)/n.n.
PlanePoint plane_point(const Vec3& p, const Vec3& f, const Vec3& g) {
  const Vec3 n = f.cross(g);
  const double square = n.squaredNorm();
  if (!(square > kSideBySide * kSideBySide * f.squaredNorm() * g.squaredNorm() &&
        square > kLeastSquare))
    return {};
  return {true, -p.dot(g.cross(n)) / square, p.dot(f.cross(n)) / square, (p.dot(n) / square) * n};
}

/// Point of least norm on one of the lines of a border.
struct BorderPoint {
  int from = 0, to = 0;  ///< the differences that the line joins
  double share = 0;      ///< way between them [1]
  Vec3 difference{0, 0, 0};
};

double nearest_share(const Vec3& p, const Vec3& q) {
  const Vec3 e = q - p;
  const double square = e.squaredNorm();
  return square > kLeastSquare ? std::clamp(-p.dot(e) / square, 0.0, 1.0) : 0;
}

// The part of p across e is e x (p x e)/e.e; so written it is across e to rounding, which p + s e
// is not where it is short. The nearer end has less to lose.
Vec3 line_difference(const Vec3& p, const Vec3& q, double share) {
  if (share <= 0) return p;
  if (share >= 1) return q;
  const Vec3 e = q - p;
  return e.cross((share < 0.5 ? p : q).cross(e)) / e.squaredNorm();
}

template <std::size_t n_lines>
BorderPoint border_point(const std::array<Vec3, 4>& d,
                         const std::array<std::array<int, 2>, n_lines>& lines) {
  BorderPoint best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : lines) {
    const double share = nearest_share(d[from], d[to]);
    const double square = (d[from] + share * (d[to] - d[from])).squaredNorm();
    if (!(square < least)) continue;
    least = square;
    best = {from, to, share, Vec3::Zero()};
  }
  best.difference = line_difference(d[best.from], d[best.to], best.share);
  return best;
}

/// Differences of a vertex and a face fill a triangle.
ClosestPoints vertex_face_points(const std::array<Vec3, 4>& d) {
  constexpr std::array<std::array<int, 2>, 3> kLines{{{0, 1}, {1, 2}, {2, 0}}};
  const PlanePoint inside = plane_point(d[0], d[1] - d[0], d[2] - d[0]);
  if (inside.is_known && inside.v >= 0 && inside.w >= 0 && inside.v + inside.w <= 1)
    return {{1, 1 - (inside.v + inside.w), inside.v, inside.w}, inside.difference};
  const BorderPoint point = border_point(d, kLines);
  ClosestPoints closest{{1, 0, 0, 0}, point.difference};
  closest.weights[1 + point.from] = 1 - point.share;
  closest.weights[1 + point.to] = point.share;
  return closest;
}

/// Differences of two edges fill a parallelogram.
ClosestPoints edge_points(const std::array<Vec3, 4>& d) {
  constexpr std::array<std::array<int, 2>, 4> kLines{{{0, 1}, {2, 3}, {0, 2}, {1, 3}}};
  const PlanePoint inside = plane_point(d[0], d[1] - d[0], d[2] - d[0]);
  if (inside.is_known && inside.v >= 0 && inside.v <= 1 && inside.w >= 0 && inside.w <= 1)
    return {{1 - inside.w, inside.w, 1 - inside.v, inside.v}, inside.difference};
  const BorderPoint point = border_point(d, kLines);
  // A difference's number is 2 a + b, a and b the ends that it joins.
  const int from_a = point.from / 2;
  const int to_a = point.to / 2;
  const double at_a = (1 - point.share) * from_a + point.share * to_a;
  const double at_b = (1 - point.share) * (point.from % 2) + point.share * (point.to % 2);
  return {{1 - at_a, at_a, 1 - at_b, at_b}, point.difference};
}

}  // namespace

ClosestPoints closest_points(const std::array<Vec3, 4>& differences, int count) {
  return count == 3 ? vertex_face_points(differences) : edge_points(differences);
}

}  // namespace pleat
