#include "core/contact/swept_cone.h"

#include <algorithm>
#include <cmath>

namespace pleat {
namespace {

/// Height above the surface, relative to the larger radius, at which a path has met it [1]. Far
/// above rounding; the share of the substep errs by this over the path's slope.
constexpr double kMeetingHeight = 1e-12;

/// Each of Newton's steps quarters the height at least, so 10 m are 1e-12 m after 22.
constexpr int kMaxSteps = 40;

/// A local direction that is perpendicular to every row of balls.
const Vec3 kOff{1, 0, 0};

/// The normal of a row's side that faces a unit direction off the row.
Vec3 side_normal(const BallRow& row, const Vec3& off) {
  return row.cosine * off - row.sine * row.direction;
}

/// A place as a row of balls sees it.
struct RowPlace {
  double along;  ///< the row, from its start [m]
  Vec3 arm;      ///< the place, seen from the nearest point of the row's line [m]
  double off;    ///< its length [m]
};

RowPlace seen_from(const BallRow& row, const Vec3& place) {
  const Vec3 from_begin = place - row.begin;
  const double along = from_begin.dot(row.direction);
  const Vec3 arm = from_begin - along * row.direction;
  return {along, arm, arm.norm()};
}

/// The ball of a row nearest to a place, as a share of the row.
///
/// Let y be along the row and rho off it: sqrt(rho^2 + (y - t)^2) - r - t sin is least where
/// t = y + rho tan.
double nearest_share(const BallRow& row, const RowPlace& place) {
  const double share = (place.along + place.off * row.tangent) * row.per_length;
  return std::clamp(share, row.first_share, row.last_share);
}

/// The gap to the ball at a share of the row.
Gap ball_gap(const BallRow& row, double share, const RowPlace& place) {
  const double ahead = place.along - share * row.length;
  const double distance = std::sqrt(place.off * place.off + ahead * ahead);
  return {
      distance - row.radius_at(share),
      distance > 0 ? Vec3((place.arm + ahead * row.direction) / distance) : side_normal(row, kOff)};
}

/// The gap to a row whose nearest ball is at a share. Between the ends the normal is at the fixed
/// angle of the cone's side to the axis, which holds where the arm vanishes too.
Gap row_gap(const BallRow& row, double share, const RowPlace& place) {
  if (share <= 0 || share >= 1) return ball_gap(row, share, place);
  return {row.cosine * place.off - row.sine * place.along - row.radius,
          side_normal(row, place.off > 0 ? Vec3(place.arm / place.off) : kOff)};
}

/// The edge of a cone without width is its axis.
Gap edge_gap(const SweptCone& cone, const Vec3& folded) {
  const RowPlace beside = seen_from(cone.edge, folded);
  return row_gap(cone.edge, nearest_share(cone.edge, beside), beside);
}

/// Folded by symmetry to the side where the trapezoid of centres has its slanted edge, the place is
/// (x, y, w), and the ball about the centre (0, t, u) is at
///   sqrt(x^2 + (y - t)^2 + (w - u)^2) - r(t),
/// a convex function of t and u. Were the trapezoid wider, it would be least at u = w and where the
/// row along the axis is nearest in the plane w = 0. If that is not inside of the trapezoid, the
/// function falls all the way there from any centre, through the edge: its least lies on that.
Gap wide_gap(const SweptCone& cone, const Vec3& folded) {
  const RowPlace above = seen_from(cone.axis, {folded.x(), folded.y(), 0});
  const double share = nearest_share(cone.axis, above);
  if (folded.z() <= cone.half_width_at(share)) return row_gap(cone.axis, share, above);
  return edge_gap(cone, folded);
}

Gap local_gap(const SweptCone& cone, const Vec3& place) {
  const Vec3 folded(place.x(), place.y(), std::abs(place.z()));
  Gap nearest = cone.has_width ? wide_gap(cone, folded) : edge_gap(cone, folded);
  if (place.z() < 0) nearest.normal.z() = -nearest.normal.z();
  return nearest;
}

void set_radii(BallRow& row, double radius_begin, double radius_end) {
  row.radius = radius_begin;
  row.growth = radius_end - radius_begin;
  if (std::abs(row.growth) < row.length) {
    row.sine = row.growth / row.length;
    row.cosine = std::sqrt((1 - row.sine) * (1 + row.sine));
    row.tangent = row.sine / row.cosine;
    row.first_share = 0;
    row.last_share = 1;
  } else {
    row.sine = row.tangent = 0;
    row.cosine = 1;
    row.first_share = row.last_share = row.growth > 0 ? 1 : 0;
  }
}

BallRow ball_row(const Vec3& begin, const Vec3& end, double radius_begin, double radius_end) {
  BallRow row;
  row.begin = begin;
  row.length = (end - begin).norm();
  if (row.length > 0) {
    row.direction = (end - begin) / row.length;
    row.per_length = 1 / row.length;
  }
  set_radii(row, radius_begin, radius_end);
  return row;
}

}  // namespace

SweptCone swept(const RoundedCone& cone, const Clearance& clearance, const Vec3& shift) {
  SweptCone grown;
  grown.has_width = cone.half_width_a > 0 || cone.half_width_b > 0;
  const Vec3 way = cone.centre_b - cone.centre_a;
  const double length = way.norm();
  const Vec3 across = grown.has_width ? cone.across
                      : length > 0    ? way.unitOrthogonal()
                                      : Vec3(Vec3::UnitZ());
  const Vec3 direction = length > 0 ? Vec3(way / length) : across.unitOrthogonal();
  const double radius_a = cone.radius_a + clearance.at_a;
  const double radius_b = cone.radius_b + clearance.at_b;
  grown.origin = cone.centre_a;
  grown.to_local.row(0) = direction.cross(across).normalized();
  grown.to_local.row(1) = across.cross(grown.to_local.row(0).transpose());
  grown.to_local.row(2) = across;
  grown.axis = ball_row(Vec3::Zero(), {0, length, 0}, radius_a, radius_b);
  grown.edge =
      ball_row({0, 0, cone.half_width_a}, {0, length, cone.half_width_b}, radius_a, radius_b);
  grown.half_width = cone.half_width_a;
  grown.widening = cone.half_width_b - cone.half_width_a;
  grown.shift = shift;
  return grown;
}

void shrink(SweptCone& cone, const Clearance& inset) {
  const double radius_a = cone.axis.radius_at(0) - inset.at_a;
  const double radius_b = cone.axis.radius_at(1) - inset.at_b;
  set_radii(cone.axis, radius_a, radius_b);
  set_radii(cone.edge, radius_a, radius_b);
}

// The height is convex along the path too. So the tangent plane at the nearest point of the surface
// lies below it: Newton's steps from the start come closer from outside and never pass the surface;
// where the tangent is not met within the substep, or does not fall, neither is the solid. Steps
// converge quadratically, and at a grazing contact, a double root, still halve the rest of the way.
ConeMeeting meeting(const SweptCone& cone, const Vec3& begin, const Vec3& end, double slack) {
  const Vec3 start = cone.to_local * (begin + cone.shift - cone.origin);
  const Vec3 path = cone.to_local * (end - begin - cone.shift);
  Gap here = local_gap(cone, start);
  const double height_begin = here.distance;
  ConeMeeting none{height_begin, std::nullopt};
  if (!start.allFinite() || !path.allFinite()) return none;
  const double met_below =
      kMeetingHeight * std::max(cone.axis.radius_at(0), cone.axis.radius_at(1));
  double fraction = 0;
  Vec3 place = start;
  for (int step = 0;; ++step) {
    const double height = here.distance + slack;
    const double rate = here.normal.dot(path);
    if (step == 0 && height < 0) {
      if (rate >= 0 && local_gap(cone, start + path).distance + slack >= 0) return none;
    } else if (!(height < -rate * (1 - fraction))) {
      return none;
    }
    if (height <= met_below || step == kMaxSteps) break;
    fraction -= height / rate;
    place = start + fraction * path;
    here = local_gap(cone, place);
  }
  const Vec3 point = place - here.distance * here.normal;
  return {height_begin, Impact{fraction, cone.to_local.transpose() * here.normal,
                               cone.origin + cone.to_local.transpose() * point}};
}

Gap gap(const SweptCone& cone, const Vec3& place) {
  const Gap local = local_gap(cone, cone.to_local * (place - cone.origin));
  return {local.distance, cone.to_local.transpose() * local.normal};
}

}  // namespace pleat
