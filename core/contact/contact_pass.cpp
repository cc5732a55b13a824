#include "core/contact/contact_pass.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/check.h"

namespace pleat {
namespace {

/// Depth, relative to the coordinates, that is rounding and not a contact once a solid has acted
/// [1]. Rounding leaves about 1e-16; a larger slack would show as penetration.
constexpr double kRoundingSlack = 1e-12;

/// Solids that may act on one vertex in one substep. Two always end in two; more need more only in
/// a corner.
constexpr int kMaxMeetings = 16;

/// Two solids whose normals have a smaller sine than this squeeze the vertex: along the one there
/// is no way out of the other. It would leave at their speed divided by the sine.
constexpr double kLeastSine = 0.04;

double sagitta(double radius, double face_radius) {
  if (!std::isfinite(radius)) return 0;
  return std::sqrt(radius * radius + face_radius * face_radius) - radius;
}

/// Distance between balls [m]; negative where they overlap.
double distance(const Sphere& a, const Sphere& b) {
  return (a.centre - b.centre).norm() - a.radius - b.radius;
}

DistanceBudget::Hull hull(const RoundedCone& cone, const Clearance& clearance) {
  const Vec3 side_a = cone.half_width_a * cone.across;
  const Vec3 side_b = cone.half_width_b * cone.across;
  return {{cone.centre_a - side_a, cone.centre_a + side_a, cone.centre_b - side_b,
           cone.centre_b + side_b},
          std::max(cone.radius_a + clearance.at_a, cone.radius_b + clearance.at_b)};
}

bool is_no_cone(const Collider& collider) {
  return !std::holds_alternative<RoundedCone>(collider.shape);
}

/// One whose motion only shifts it.
bool is_plain(const Collider& collider) { return is_no_cone(collider) && !collider.motion.turns(); }

/// Calls the action with the one of the solids that it is, as std::visit does, but inline: that
/// goes through a table of functions, and this runs for every vertex.
template <class... Solids, class Action>
void with_solid(const std::variant<Solids...>& solid, const Action& action) {
  const auto with = [&](const auto* one) {
    if (one) action(*one);
    return one != nullptr;
  };
  (with(std::get_if<Solids>(&solid)) || ...);
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

ContactPass::ContactPass(std::vector<Collider> colliders, const ContactOptions& options)
    : colliders_(std::move(colliders)) {
  for (const Collider& collider : colliders_) collider.validate();
  const auto first_framed = std::stable_partition(colliders_.begin(), colliders_.end(), is_plain);
  const auto first_cone = std::stable_partition(first_framed, colliders_.end(), is_no_cone);
  first_framed_ = static_cast<std::size_t>(first_framed - colliders_.begin());
  first_cone_ = static_cast<std::size_t>(first_cone - colliders_.begin());
  solids_.resize(colliders_.size());
  poses_begin_.resize(colliders_.size());
  poses_end_.resize(colliders_.size());
  set_options(options);
}

/// Finds balls that are apart at the start: those that overlap there are one body, with no gap.
void ContactPass::find_gaps() {
  gaps_.clear();
  if (largest_face_radius_ == 0) return;
  for (std::size_t k = 0; k < colliders_.size(); ++k) {
    const auto* ball = std::get_if<Sphere>(&colliders_[k].shape);
    for (std::size_t i = 0; ball && i < colliders_.size(); ++i) {
      const auto* other = std::get_if<Sphere>(&colliders_[i].shape);
      if (i != k && other && distance(*ball, *other) > 2 * options_.half_thickness)
        gaps_.push_back({k, i});
    }
  }
}

double ContactPass::most_sagitta(std::size_t ball, std::span<const Pose> poses) const {
  double most = std::numeric_limits<double>::infinity();
  for (const auto& [one, other] : gaps_) {
    if (one != ball) continue;
    const auto ball_at = [&](std::size_t k) {
      return pleat::placed(std::get<Sphere>(colliders_[k].shape), poses[k]);
    };
    const double apart = distance(ball_at(one), ball_at(other));
    most = std::min(most, std::max(0.0, apart / 2 - options_.half_thickness) / 2);
  }
  return most;
}

void ContactPass::set_options(const ContactOptions& options) {
  const auto is_size = [](double size) { return size >= 0 && std::isfinite(size); };
  const Eigen::VectorXd& radii = options.face_radii;
  PLEAT_CHECK(is_size(options.half_thickness), "the cloth's half thickness must not be negative");
  PLEAT_CHECK(std::all_of(radii.begin(), radii.end(), is_size),
              "the faces' radii must not be negative");
  options_ = options;
  largest_face_radius_ = radii.size() > 0 ? radii.maxCoeff() : 0;
  is_graded_ = radii.size() > 0 && radii.minCoeff() < largest_face_radius_;
  find_gaps();
  make_budget();
}

Clearance ContactPass::clearance(const Roundness& solid, double face_radius) const {
  const auto off = [&](double radius) {
    return options_.half_thickness + std::min(sagitta(radius, face_radius), solid.most_sagitta);
  };
  return {off(solid.radii[0]), off(solid.radii[1])};
}

Clearance ContactPass::clearance(const Collider& collider, VertexId vertex) const {
  return clearance(Roundness{end_radii(collider.shape)}, face_radius(vertex));
}

double ContactPass::face_radius(VertexId vertex) const {
  return is_graded_ ? options_.face_radii[vertex] : largest_face_radius_;
}

/// The shape of a solid as this vertex is held off it.
template <class Shape, class Action>
auto ContactPass::with_held(const Solid& solid, const Shape& shape, VertexId vertex,
                            const Action& action) const {
  if (!is_graded_) return action(shape);
  const Clearance largest = clearance(solid.roundness, largest_face_radius_);
  const Clearance its = clearance(solid.roundness, options_.face_radii[vertex]);
  Shape own = shape;
  shrink(own, {largest.at_a - its.at_a, largest.at_b - its.at_b});
  return action(own);
}

/// Gap of a place when the substep ends, from where the solid holds the vertex.
Gap ContactPass::held_gap(const Solid& solid, VertexId vertex, const Vec3& place) const {
  return with_held(solid, solid.swept, vertex,
                   [&](const SweptSolid& held) { return gap(held, place); });
}

void ContactPass::make_budget() {
  std::vector<DistanceBudget::Hull> hulls;
  for (std::size_t k = first_cone_; k < colliders_.size(); ++k) {
    const auto& cone = std::get<RoundedCone>(colliders_[k].shape);
    hulls.push_back(hull(cone, clearance(Roundness{end_radii(cone)}, largest_face_radius_)));
  }
  budget_ = DistanceBudget(std::move(hulls));
}

void ContactPass::place(const Collider& collider, const Pose& begin, const Pose& end,
                        Solid& solid) const {
  solid.turns = begin.rotation != end.rotation;
  solid.roundness.radii = end_radii(collider.shape);
  solid.friction = collider.friction;
  Vec3 shift = Vec3::Zero();
  if (solid.turns) {
    solid.carry = end * begin.inverse();
    solid.back = solid.carry.inverse();
  } else {
    shift = end.translation - begin.translation;
    solid.velocity = shift / substep_;
  }
  solid.swept = swept(pleat::placed(collider.shape, end),
                      clearance(solid.roundness, largest_face_radius_), shift);
}

void ContactPass::begin_substep(double time_begin, double time_end) {
  PLEAT_CHECK(time_end > time_begin, "a substep must end after it begins");
  substep_ = time_end - time_begin;
  for (std::size_t k = 0; k < colliders_.size(); ++k) {
    poses_begin_[k] = colliders_[k].motion.pose(time_begin);
    poses_end_[k] = colliders_[k].motion.pose(time_end);
  }
  for (std::size_t k = 0; k < colliders_.size(); ++k) {
    solids_[k].roundness.most_sagitta = most_sagitta(k, poses_end_);
    place(colliders_[k], poses_begin_[k], poses_end_[k], solids_[k]);
  }
  if (first_cone_ < colliders_.size())
    budget_.begin_substep(std::span(poses_begin_).subspan(first_cone_),
                          std::span(poses_end_).subspan(first_cone_));
}

Vec3 ContactPass::velocity_at(const Solid& solid, const Vec3& place) const {
  return solid.turns ? Vec3((place - solid.back * place) / substep_) : solid.velocity;
}

/// The vertex's path as the solid sees it [m].
Vec3 ContactPass::relative_path(const Solid& solid, const Vec3& begin, const Vec3& end) {
  if (solid.turns) return end - solid.carry * begin;
  return end - begin - std::visit([](const auto& shape) { return shape.shift; }, solid.swept);
}

void ContactPass::Meeting::keep_earlier(const Solid& other, const std::optional<Impact>& met) {
  if (!met || (solid && met->fraction >= impact.fraction)) return;
  solid = &other;
  impact = *met;
}

void ContactPass::meet_framed(VertexId vertex, const Vec3& begin, const Vec3& end, double slack,
                              const Solid* skipped, Meeting& earliest) {
  for (std::size_t k = first_framed_; k < first_cone_; ++k) {
    const Solid& solid = solids_[k];
    if (&solid == skipped) continue;
    const Vec3 from = solid.turns ? solid.carry * begin : begin;
    with_solid(solid.swept, [&](const auto& shape) {
      earliest.keep_earlier(solid, with_held(solid, shape, vertex, [&](const auto& held) {
                              return first_impact(held, from, end, slack);
                            }));
    });
  }
  if (first_cone_ == solids_.size()) return;
  budget_.visit_near(vertex, begin, end, [&](std::size_t k) {
    const Solid& solid = solids_[first_cone_ + k];
    if (&solid == skipped) return -std::numeric_limits<double>::infinity();
    const Vec3 from = solid.turns ? solid.carry * begin : begin;
    const auto& cone = std::get<SweptCone>(solid.swept);
    const ConeMeeting met = with_held(solid, cone, vertex, [&](const SweptCone& held) {
      return meeting(held, from, end, slack);
    });
    earliest.keep_earlier(solid, met.impact);
    return met.height_begin;
  });
}

ContactPass::Meeting ContactPass::earliest_meeting(VertexId vertex, const Vec3& begin,
                                                   const Vec3& end, double slack,
                                                   const Solid* skipped) {
  Meeting earliest;
  for (std::size_t k = 0; k < first_framed_; ++k) {
    const Solid& solid = solids_[k];
    if (&solid == skipped) continue;
    with_solid(solid.swept, [&](const auto& shape) {
      if (may_touch(shape, begin, end))
        earliest.keep_earlier(solid, with_held(solid, shape, vertex, [&](const auto& held) {
                                return first_impact(held, begin, end, slack);
                              }));
    });
  }
  if (first_framed_ < solids_.size()) meet_framed(vertex, begin, end, slack, skipped, earliest);
  return earliest;
}

/// Height of a place above the solid itself, without clearance [m].
double ContactPass::bare_height(const Solid& solid, const Vec3& place) const {
  SweptSolid bare = solid.swept;
  shrink(bare, clearance(solid.roundness, largest_face_radius_));
  return gap(bare, place).distance;
}

/// True at a place where two rough solids leave less between them than the cloth is thick: they
/// press as hard as it takes, so that nothing pulls it out.
bool ContactPass::grips(const Solid& a, const Solid& b, const Vec3& place) const {
  if (a.friction <= 0 || b.friction <= 0) return false;
  const double above_a = bare_height(a, place);
  const double above_b = bare_height(b, place);
  return above_a >= 0 && above_b >= 0 && above_a + above_b < 2 * options_.half_thickness;
}

// One solid acts at a time, the earliest first. With n its normal where the vertex meets it at the
// share s of the substep, u the velocity and d the path relative to it, and t marking the part
// across n:
//   u <- slip u_t + max(u_n, 0) n,   x <- point + (1 - s) slip d_t,
// or, where it bounces, with |u_n| and the mirrored rest of d_n. A vertex that sticks stays where
// it met the solid, to the bit. The new place lies on the tangent plane, never inside of a convex
// solid. Should this lead into the solid that acted before, the vertex slides along the new one, in
// the direction m = n_b - (n_b . n) n, until it is on the old one's tangent plane as well; then it
// is clear of both. Where solids leave it no place with its clearance, the middle of the last two
// places is as far inside of either's, and may yet be outside of the solids themselves. Rough ones
// that grip it carry it along.
std::optional<ContactPass::Touch> ContactPass::resolve(VertexId vertex, const Vec3& position_begin,
                                                       Vec3& position, Vec3& velocity,
                                                       const Touch* settled) {
  const Solid* before = settled ? &solids_[static_cast<std::size_t>(settled->solid)] : nullptr;
  Touch touch = settled ? *settled : Touch{};
  Meeting meeting = earliest_meeting(vertex, position_begin, position, 0, before);
  if (!meeting.solid || !velocity.allFinite())
    return settled ? std::optional<Touch>(touch) : std::nullopt;
  const bool bounces = options_.response == ContactResponse::uniform;
  Vec3 place_before = position;
  for (int n_meetings = 0; meeting.solid; ++n_meetings) {
    if (n_meetings == kMaxMeetings) {
      ++n_unresolved_;
      const Vec3 middle = (place_before + position) / 2;
      if (bare_height(*before, middle) < 0 || bare_height(*meeting.solid, middle) < 0) break;
      position = middle;
      if (!grips(*before, *meeting.solid, middle)) break;
      if (!grips(*before, *meeting.solid, position_begin)) break;
      touch.sticks = true;
      velocity = (velocity_at(*before, middle) + velocity_at(*meeting.solid, middle)) / 2;
      position += tangential(position_begin + substep_ * velocity - middle, touch.normal);
      break;
    }
    place_before = position;
    const Solid& solid = *meeting.solid;
    const Vec3& normal = meeting.impact.normal;
    const Vec3 whole_path = relative_path(solid, position_begin, position);
    const Vec3 path = tangential(whole_path, normal);
    const Vec3 solid_velocity = velocity_at(solid, meeting.impact.point);
    const Vec3 relative_velocity = velocity - solid_velocity;
    const double normal_speed = normal.dot(relative_velocity);
    const Vec3 tangential_velocity = relative_velocity - normal_speed * normal;
    const double parting_speed = bounces ? std::abs(normal_speed) : std::max(normal_speed, 0.0);
    const double left =
        slip(solid.friction, parting_speed - normal_speed, tangential_velocity.norm());
    touch = {vertex, static_cast<int>(&solid - solids_.data()), normal, left == 0,
             before != nullptr};
    const double path_left = 1 - meeting.impact.fraction;
    position = meeting.impact.point + path_left * left * path;
    if (bounces) position += path_left * std::max(-normal.dot(whole_path), 0.0) * normal;
    velocity = solid_velocity + left * tangential_velocity + parting_speed * normal;

    if (before) {
      const Gap other = held_gap(*before, vertex, position);
      const Vec3 along = tangential(other.normal, normal);
      const double squared_sine = along.squaredNorm();
      if (squared_sine > kLeastSine * kLeastSine) {
        const double speed = other.normal.dot(velocity - velocity_at(*before, position));
        if (other.distance < 0) position -= other.distance / squared_sine * along;
        if (speed < 0) velocity -= speed / squared_sine * along;
      }
    }
    before = &solid;
    const double slack = kRoundingSlack * (position.cwiseAbs().maxCoeff() + path.norm());
    meeting = earliest_meeting(vertex, position_begin, position, slack, before);
  }
  return touch;
}

std::optional<ContactPass::Touch> ContactPass::first_met(VertexId vertex,
                                                         const Vec3& position_begin,
                                                         const Vec3& position) {
  const Meeting meeting = earliest_meeting(vertex, position_begin, position, 0, nullptr);
  if (!meeting.solid) return std::nullopt;
  const Vec3 from = position - relative_path(*meeting.solid, position_begin, position);
  const bool is_inside =
      meeting.impact.fraction == 0 && (meeting.impact.point - from).norm() > kTouchDistance;
  if (is_inside) return std::nullopt;
  return Touch{vertex, static_cast<int>(meeting.solid - solids_.data()), meeting.impact.normal};
}

std::span<const ContactPass::Touch> ContactPass::resolve(const PositionsView& positions_begin,
                                                         std::span<const char> is_exempt,
                                                         PositionsRef positions,
                                                         PositionsRef velocities,
                                                         std::span<const Touch> settled) {
  const Eigen::Index n_vertices = positions.cols();
  PLEAT_CHECK(positions_begin.cols() == n_vertices && velocities.cols() == n_vertices &&
                  is_exempt.size() == static_cast<std::size_t>(n_vertices),
              "contact takes a whole state");
  touches_.clear();
  touches_.reserve(static_cast<std::size_t>(n_vertices));
  auto next_settled = settled.begin();
  for (Eigen::Index i = 0; i < n_vertices; ++i) {
    if (is_exempt[static_cast<std::size_t>(i)] != 0) continue;
    const bool is_settled = next_settled != settled.end() && next_settled->vertex == i;
    Vec3 position = positions.col(i);
    Vec3 velocity = velocities.col(i);
    const std::optional<Touch> touch = resolve(VertexId(i), positions_begin.col(i), position,
                                               velocity, is_settled ? &*next_settled++ : nullptr);
    if (!touch) continue;
    positions.col(i) = position;
    velocities.col(i) = velocity;
    touches_.push_back(*touch);
  }
  return touches_;
}

// A solid that only shifts meets what comes within r of its middle place, grown by half its shift.
// Of one that turns by R, the way is seen from where it ends: (1 - s) R (a - c_0) + s (b - c_1),
// which is off by at most |R - I| |a - c_0| from the way between the solid's own places. With rho =
// |R - I| at most 1/4 and q the latter's least length, q (1 - rho) - rho (|a - b| + |c_1 - c_0|) >
// r keeps it out; a ball of r / (1 - rho) + |c_1 - c_0| and a distance of |a - b| ask for more.
void ContactPass::outlines(std::vector<Outline>& outlines) const {
  constexpr double kEverywhere = std::numeric_limits<double>::infinity();
  constexpr double kLargestTurn = 0.25;
  const bool rests = options_.response == ContactResponse::resting;
  outlines.clear();
  for (std::size_t k = 0; k < solids_.size(); ++k) {
    const Solid& solid = solids_[k];
    const bool is_plain = k < first_framed_;
    Outline outline;
    outline.friction = solid.friction;
    const auto* plane = std::get_if<SweptPlane>(&solid.swept);
    const auto* ball = std::get_if<SweptSphere>(&solid.swept);
    if (is_plain && (plane || ball)) {
      if (plane) outline.shape = *plane;
      if (ball) outline.shape = *ball;
      outline.is_exact = rests && !is_graded_;
      outline.longest_shift = ((plane ? plane->shift : ball->shift) - drift()).norm();
    } else {
      const double turn = solid.turns ? (solid.carry.rotation - Mat3::Identity()).norm() : 0;
      const Sphere around = ball_around(colliders_[k].shape);
      const Vec3 begin = poses_begin_[k] * around.centre;
      const Vec3 end = poses_end_[k] * around.centre;
      const Clearance held = clearance(solid.roundness, largest_face_radius_);
      const double shift = (end - begin).norm();
      const double radius = (around.radius + std::max(held.at_a, held.at_b)) / (1 - turn) + shift;
      outline.shape =
          SweptSphere{(begin + end) / 2, turn > kLargestTurn ? kEverywhere : radius, Vec3::Zero()};
      outline.cone = std::get_if<SweptCone>(&solid.swept);
      if (outline.cone) {
        outline.is_exact = rests && turn <= kLargestTurn;
        outline.longest_shift = budget_.move(k - first_cone_);
        outline.radii = solid.roundness.radii;
        outline.carry = solid.turns ? solid.carry : Pose{Mat3::Identity(), outline.cone->shift};
      }
    }
    outlines.push_back(outline);
  }
}

double ContactPass::least_gap(const PositionsView& positions,
                              std::span<const char> is_exempt) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Solid& solid : solids_) {
    for (Eigen::Index i = 0; i < positions.cols(); ++i) {
      if (is_exempt[static_cast<std::size_t>(i)] != 0) continue;
      least = std::min(least, held_gap(solid, VertexId(i), positions.col(i)).distance);
    }
  }
  return least;
}

Vec3 ContactPass::solid_velocity(const Touch& touch, const Vec3& place_begin) const {
  const Solid& solid = solids_[static_cast<std::size_t>(touch.solid)];
  return solid.turns ? Vec3((solid.carry * place_begin - place_begin) / substep_) : solid.velocity;
}

Gap ContactPass::gap_at_end(const Touch& touch, const Vec3& place) const {
  return held_gap(solids_[static_cast<std::size_t>(touch.solid)], touch.vertex, place);
}

std::vector<ContactPass::Support> ContactPass::supports(const PositionsView& positions, double time,
                                                        double within) const {
  std::vector<Support> found;
  std::vector<Pose> poses;
  for (const Collider& collider : colliders_) poses.push_back(collider.motion.pose(time));
  for (std::size_t k = 0; k < colliders_.size(); ++k) {
    const Collider& collider = colliders_[k];
    const Roundness roundness{end_radii(collider.shape), most_sagitta(k, poses)};
    const SweptSolid bare =
        swept(pleat::placed(collider.shape, poses[k]), Clearance{}, Vec3::Zero());
    for (Eigen::Index i = 0; i < positions.cols(); ++i) {
      const Clearance held = clearance(roundness, face_radius(VertexId(i)));
      const Gap point = gap(bare, positions.col(i));
      const double height = point.distance - std::max(held.at_a, held.at_b);
      if (height <= within)
        found.push_back(
            {VertexId(i), point.normal, collider.friction, static_cast<int>(k), height});
    }
  }
  return found;
}

std::size_t ContactPass::bytes() const {
  return colliders_.size() * (sizeof(Collider) + sizeof(Solid) + 2 * sizeof(Pose)) +
         static_cast<std::size_t>(options_.face_radii.size()) * sizeof(double);
}

Penetration ContactPass::penetration(const PositionsView& positions, double time) const {
  std::vector<SweptSolid> solids;
  for (const Collider& collider : colliders_)
    solids.push_back(swept(placed(collider, time), Clearance{}, Vec3::Zero()));
  Penetration found;
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    double depth = 0;
    for (const SweptSolid& solid : solids)
      depth = std::max(depth, -gap(solid, positions.col(i)).distance);
    if (depth > 0) ++found.n_inside;
    if (depth > found.depth) {
      found.depth = depth;
      found.deepest = VertexId(i);
    }
  }
  return found;
}

}  // namespace pleat
