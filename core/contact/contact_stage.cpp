#include "core/contact/contact_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/check.h"

namespace pleat {
namespace {

/// How far a normal's length may be from one; scene files carry 15 digits, hand-written ones fewer.
constexpr double kUnitTolerance = 1e-9;

/// Depth, relative to the coordinates, that is rounding and not a contact once a solid has acted
/// [1]. Rounding leaves about 1e-16; a larger slack would show as penetration.
constexpr double kRoundingSlack = 1e-12;

/// Solids that may act on one vertex in one substep. Two always end in two; more need more only in
/// a corner.
constexpr int kMaxMeetings = 16;

/// Two solids whose normals have a smaller sine than this squeeze the vertex: along the one there
/// is no way out of the other.
constexpr double kLeastSine = 1e-6;

double sagitta(double radius, double circumradius) {
  return std::sqrt(radius * radius + circumradius * circumradius) - radius;
}

void validate(const Collider& collider) {
  PLEAT_CHECK(collider.friction >= 0 && std::isfinite(collider.friction),
              "a collider's friction must not be negative");
  if (const auto* plane = std::get_if<Plane>(&collider.shape)) {
    PLEAT_CHECK(plane->point.allFinite(), "a plane's point must be finite");
    PLEAT_CHECK(std::abs(plane->normal.norm() - 1) <= kUnitTolerance,
                "a plane's normal must be a unit vector");
  } else if (const auto* sphere = std::get_if<Sphere>(&collider.shape)) {
    PLEAT_CHECK(sphere->centre.allFinite(), "a sphere's centre must be finite");
    PLEAT_CHECK(sphere->radius > 0 && std::isfinite(sphere->radius),
                "a sphere's radius must be positive");
  }
}

SweptPlane swept(const Plane& plane, const Vec3& offset_begin, const Vec3& offset_end,
                 double clearance) {
  const Vec3 point = plane.point + offset_end;
  return {plane.normal, plane.normal.dot(point) + clearance, offset_end - offset_begin};
}

SweptSphere swept(const Sphere& sphere, const Vec3& offset_begin, const Vec3& offset_end,
                  double clearance) {
  return {sphere.centre + offset_end, sphere.radius + clearance, offset_end - offset_begin};
}

/// Share of the tangential motion that friction leaves: the tangential velocity changes by at most
/// friction times the normal one. A solid that takes no normal velocity away holds nothing.
double slip(double friction, double normal_change, double tangential_speed) {
  const double limit = friction * normal_change;
  if (limit == 0) return 1;
  return tangential_speed > limit ? 1 - limit / tangential_speed : 0;
}

/// The part of `vector` without its component along the unit `normal`.
Vec3 tangential(const Vec3& vector, const Vec3& normal) {
  return vector - normal.dot(vector) * normal;
}

}  // namespace

ContactStage::ContactStage(std::vector<Collider> colliders, const ContactOptions& options)
    : colliders_(std::move(colliders)) {
  set_options(options);
  for (const Collider& collider : colliders_) validate(collider);
  solids_.resize(colliders_.size());
}

void ContactStage::set_options(const ContactOptions& options) {
  PLEAT_CHECK(options.half_thickness >= 0 && std::isfinite(options.half_thickness),
              "the cloth's half thickness must not be negative");
  PLEAT_CHECK(options.face_circumradius >= 0 && std::isfinite(options.face_circumradius),
              "the faces' circumradius must not be negative");
  options_ = options;
}

double ContactStage::clearance(const Collider& collider) const {
  const auto* sphere = std::get_if<Sphere>(&collider.shape);
  return options_.half_thickness +
         (sphere ? sagitta(sphere->radius, options_.face_circumradius) : 0);
}

std::variant<Plane, Sphere> ContactStage::placed(const Collider& collider, double time) {
  std::variant<Plane, Sphere> shape = collider.shape;
  const Vec3 offset = collider.motion.pose(time).translation;
  if (auto* plane = std::get_if<Plane>(&shape)) plane->point += offset;
  if (auto* sphere = std::get_if<Sphere>(&shape)) sphere->centre += offset;
  return shape;
}

void ContactStage::begin_substep(double time_begin, double time_end) {
  PLEAT_CHECK(time_end > time_begin, "a substep must end after it begins");
  for (std::size_t k = 0; k < colliders_.size(); ++k) {
    const Collider& collider = colliders_[k];
    const Vec3 offset_begin = collider.motion.pose(time_begin).translation;
    const Vec3 offset_end = collider.motion.pose(time_end).translation;
    const double distance = clearance(collider);
    Solid& solid = solids_[k];
    std::visit(
        [&](const auto& shape) { solid.swept = swept(shape, offset_begin, offset_end, distance); },
        collider.shape);
    solid.velocity = (offset_end - offset_begin) / (time_end - time_begin);
    solid.friction = collider.friction;
  }
}

ContactStage::Meeting ContactStage::earliest_meeting(const Vec3& begin, const Vec3& end,
                                                     double slack, const Solid* skipped) const {
  Meeting earliest;
  const auto meet = [&](const Solid& solid, const auto& shape) {
    if (!may_touch(shape, begin, end)) return;
    const auto impact = first_impact(shape, begin, end, slack);
    if (!impact || (earliest.solid && impact->fraction >= earliest.impact.fraction)) return;
    earliest = {&solid, *impact};
  };
  for (const Solid& solid : solids_) {
    if (&solid == skipped) continue;
    // Not std::visit: it goes through a table of functions, and this loop runs for every vertex.
    if (const auto* plane = std::get_if<SweptPlane>(&solid.swept)) {
      meet(solid, *plane);
    } else if (const auto* sphere = std::get_if<SweptSphere>(&solid.swept)) {
      meet(solid, *sphere);
    }
  }
  return earliest;
}

// One solid acts at a time, the earliest first. With n its normal where the vertex meets it at the
// share s of the substep, u the velocity and d the path relative to it, and t marking the part
// across n:
//   u <- slip u_t + max(u_n, 0) n,   x <- point + (1 - s) slip d_t.
// Friction thus acts on the path after the impact as it does on the velocity; a vertex that sticks
// stays where it met the solid, to the bit. The new place lies on the tangent plane, never inside
// of a convex solid. Should this lead into the solid that acted before, the vertex slides along the
// new one, in the direction m = n_b - (n_b . n) n, until it is on the old one's tangent plane as
// well; then it is clear of both.
bool ContactStage::resolve(const Vec3& position_begin, Vec3& position, Vec3& velocity) {
  Meeting meeting = earliest_meeting(position_begin, position, 0, nullptr);
  if (!meeting.solid || !velocity.allFinite()) return false;
  const Solid* before = nullptr;
  for (int n_meetings = 0; meeting.solid; ++n_meetings) {
    if (n_meetings == kMaxMeetings) {
      ++n_unresolved_;
      break;
    }
    const Solid& solid = *meeting.solid;
    const Vec3& normal = meeting.impact.normal;
    const Vec3 shift = std::visit([](const auto& shape) { return shape.shift; }, solid.swept);
    const Vec3 path = tangential(position - position_begin - shift, normal);
    const Vec3 relative_velocity = velocity - solid.velocity;
    const double normal_speed = normal.dot(relative_velocity);
    const Vec3 tangential_velocity = relative_velocity - normal_speed * normal;
    const double left =
        slip(solid.friction, std::max(-normal_speed, 0.0), tangential_velocity.norm());
    position = meeting.impact.point + (1 - meeting.impact.fraction) * left * path;
    velocity = solid.velocity + left * tangential_velocity + std::max(normal_speed, 0.0) * normal;

    if (before) {
      const Gap other =
          std::visit([&](const auto& shape) { return gap(shape, position); }, before->swept);
      const Vec3 along = tangential(other.normal, normal);
      const double squared_sine = along.squaredNorm();
      if (squared_sine > kLeastSine * kLeastSine) {
        const double speed = other.normal.dot(velocity - before->velocity);
        if (other.distance < 0) position -= other.distance / squared_sine * along;
        if (speed < 0) velocity -= speed / squared_sine * along;
      }
    }
    before = &solid;
    const double slack = kRoundingSlack * (position.cwiseAbs().maxCoeff() + path.norm());
    meeting = earliest_meeting(position_begin, position, slack, before);
  }
  return true;
}

}  // namespace pleat
