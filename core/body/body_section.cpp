#include "core/body/body_section.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/check.h"

namespace pleat {
namespace {

constexpr double kFullTurn = 6.283185307179586;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Interval {
  double begin, end;
};

/// The least value of a convex function on an interval, by golden section.
template <class Function>
double convex_minimum(const Function& f, Interval at) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kSections = 40;  // 4e-9 of the interval, so 1e-17 of a smooth function's height
  double low = at.end - kGolden * (at.end - at.begin);
  double high = at.begin + kGolden * (at.end - at.begin);
  double f_low = f(low);
  double f_high = f(high);
  for (int i = 0; i < kSections; ++i) {
    if (f_low < f_high) {
      at.end = high;
      high = low;
      f_high = f_low;
      low = at.end - kGolden * (at.end - at.begin);
      f_low = f(low);
    } else {
      at.begin = low;
      low = high;
      f_low = f_high;
      high = at.begin + kGolden * (at.end - at.begin);
      f_high = f(high);
    }
  }
  return std::min({f_low, f_high, f(at.begin), f(at.end)});
}

double mix(double a, double b, double t) { return a + t * (b - a); }

/// Cuts an interval of t down to where `at_0 + t (at_1 - at_0)` is not negative.
Interval where_positive(Interval t, double at_0, double at_1) {
  if (at_0 < 0 && at_1 < 0) return {1, 0};
  const double root = at_0 / (at_0 - at_1);
  if (at_0 < 0) t.begin = std::max(t.begin, root);
  if (at_1 < 0) t.end = std::min(t.end, root);
  return t;
}

/// A cone is a row of capsules across, t from 0 to 1 along the axis. At a height that is d(t) above
/// the axis each leaves a stadium of radius sqrt(r^2 - d^2), which is concave in t as the geometric
/// mean of r - d and r + d.
double reach(const RoundedCone& cone, double height, const Vec3& direction) {
  const double above_a = height - cone.centre_a.y();
  const double above_b = height - cone.centre_b.y();
  Interval met{0, 1};
  met = where_positive(met, cone.radius_a - above_a, cone.radius_b - above_b);
  met = where_positive(met, cone.radius_a + above_a, cone.radius_b + above_b);
  if (met.begin > met.end) return -kInfinity;
  const double along = std::abs(cone.across.dot(direction));
  const double at_a = cone.centre_a.dot(direction) + along * cone.half_width_a;
  const double at_b = cone.centre_b.dot(direction) + along * cone.half_width_b;
  const auto reach_back = [&](double t) {
    const double r = mix(cone.radius_a, cone.radius_b, t);
    const double d = mix(above_a, above_b, t);
    return -mix(at_a, at_b, t) - std::sqrt(std::max(0.0, (r - d) * (r + d)));
  };
  return -convex_minimum(reach_back, met);
}

/// Convex in t: the distance from a convex set of centres, less a radius linear in t.
double distance(const RoundedCone& cone, const Vec3& point) {
  const auto from_capsule = [&](double t) {
    const Vec3 from = point - cone.centre_a - t * (cone.centre_b - cone.centre_a);
    const double half_width = mix(cone.half_width_a, cone.half_width_b, t);
    const double s = std::clamp(from.dot(cone.across), -half_width, half_width);
    return (from - s * cone.across).norm() - mix(cone.radius_a, cone.radius_b, t);
  };
  return convex_minimum(from_capsule, {0, 1});
}

}  // namespace

std::vector<Vec3> evenly_spaced(std::span<const Vec3> line, int n_points) {
  std::vector<double> way = {0};
  for (std::size_t i = 1; i < line.size(); ++i)
    way.push_back(way.back() + (line[i] - line[i - 1]).norm());
  std::vector<Vec3> points;
  std::size_t piece = 1;
  for (int k = 0; k < n_points; ++k) {
    const double at = way.back() * k / n_points;
    while (piece + 1 < line.size() && way[piece] < at) ++piece;
    const double length = way[piece] - way[piece - 1];
    const double share = length > 0 ? (at - way[piece - 1]) / length : 0;
    points.emplace_back(line[piece - 1] + share * (line[piece] - line[piece - 1]));
  }
  return points;
}

Outline outline(std::span<const BodyPart> parts, double height, int n_directions) {
  Outline result = Outline::Constant(n_directions, -kInfinity);
  for (int k = 0; k < n_directions; ++k) {
    const double angle = kFullTurn * k / n_directions;
    const Vec3 direction(std::cos(angle), 0, -std::sin(angle));
    for (const BodyPart& part : parts)
      result[k] = std::max(result[k], reach(part.shape, height, direction));
  }
  PLEAT_CHECK(result.allFinite(), "an outline is taken where the body is");
  return result;
}

// A convex curve is as long as its mean reach times 2 pi (Cauchy).
double girth(const Outline& outline) { return kFullTurn * outline.mean(); }

// Tangents at neighbouring directions, an angle d apart, meet at (h' - h cos d) / sin d from where
// the first one's direction leaves the axis; h, h' are their reaches. The polygon of these points
// lies around the curve, by at most d^2 / 8 of its radius of curvature.
std::vector<Vec3> ring(const Outline& outline, double offset, double height, int n_points) {
  const auto n = outline.size();
  const double turn = kFullTurn / static_cast<double>(n);
  std::vector<Vec3> corners = {{outline[0] + offset, height, 0}};
  for (Eigen::Index k = 0; k < n; ++k) {
    const double a = turn * static_cast<double>(k);
    const double reach = outline[k] + offset;
    const double next = outline[(k + 1) % n] + offset;
    const double along = (next - reach * std::cos(turn)) / std::sin(turn);
    corners.emplace_back(reach * std::cos(a) - along * std::sin(a), height,
                         -reach * std::sin(a) - along * std::cos(a));
  }
  corners.push_back(corners.front());
  return evenly_spaced(corners, n_points);
}

double clearance(std::span<const BodyPart> parts, const Vec3& point) {
  double least = kInfinity;
  for (const BodyPart& part : parts) least = std::min(least, distance(part.shape, point));
  return least;
}

}  // namespace pleat
