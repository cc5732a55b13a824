#include "core/dynamics/position_based/lanes/contact_program.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "core/base/simd.h"

namespace pleat {
namespace {

/// Accuracy of a place in single precision, in shares of the lengths that it is made from.
constexpr double kRounding = 4e-7;

/// Vertices deeper inside than so many roundings did not come there by rounding.
constexpr float kDeep = 8;

/// Newton's steps from where a way begins to where it meets a cone. Of a way that meets it steeply
/// two do; one that grazes it may end short of the surface by a 256th of its height.
constexpr int kSteps = 4;

constexpr int kAllLanes = 15;

/// Further than anything that is met [m].
constexpr float kFar = 1e6f;

/// Bound of rounding in how far a group may go [m]: a thousand substeps of ways from a metre.
constexpr float kFreedomSlack = 3e-5f;

std::array<float, 3> to_floats(const Vec3& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

std::array<float, 3> rounded_off_floats(const Vec3& v) {
  const std::array<float, 3> rounded = to_floats(v);
  return to_floats(v - Vec3(rounded[0], rounded[1], rounded[2]));
}

Vec3Lanes<Float4> all(const std::array<float, 3>& v) {
  return {Float4::all(v[0]), Float4::all(v[1]), Float4::all(v[2])};
}

Float4 zero() { return Float4::all(0); }

template <class Pointer>
Vec3Lanes<Float4> gather(const std::array<Pointer, 3>& arrays, const LaneMembers& slots) {
  return {Float4::gather(arrays[0], slots), Float4::gather(arrays[1], slots),
          Float4::gather(arrays[2], slots)};
}

void scatter(const Vec3Lanes<Float4>& value, const std::array<float*, 3>& arrays,
             const LaneMembers& slots) {
  value.x.scatter(arrays[0], slots);
  value.y.scatter(arrays[1], slots);
  value.z.scatter(arrays[2], slots);
}

float lowest(Float4 a) {
  std::array<float, Float4::kLanes> lanes;
  a.store(lanes.data());
  return std::min(std::min(lanes[0], lanes[1]), std::min(lanes[2], lanes[3]));
}

/// `a` where `condition` is positive, else `b`, to the bit.
Float4 choose(Float4 condition, Float4 a, Float4 b) {
  const Float4 sign = where_positive(condition, Float4::all(2)) - Float4::all(1);
  return where_positive(sign, a) + where_positive(zero() - sign, b);
}

Vec3Lanes<Float4> choose(Float4 condition, const Vec3Lanes<Float4>& a, const Vec3Lanes<Float4>& b) {
  return {choose(condition, a.x, b.x), choose(condition, a.y, b.y), choose(condition, a.z, b.z)};
}

}  // namespace

/// Height of places above a solid's surface [m]; for a ball to first order.
inline Float4 ContactProgram::gap_of(const Solid& solid, const Vec3Lanes<Float4>& place) {
  const Float4 size = Float4::all(solid.size);
  if (solid.kind == Kind::plane)
    return dot(all(solid.place), place) - size - Float4::all(solid.size_low);
  return Float4::all(0.5f / solid.size) * (dot(place, place) - size * size);
}

struct ContactProgram::Ways {
  Vec3Lanes<Float4> begin;  // place from the centre; for a plane from the origin
  Vec3Lanes<Float4> way;
  Vec3Lanes<Float4> shift;   // solid's shift where the way starts
  Vec3Lanes<Float4> offset;  // start above, seen from the vertex's rounded start
};

/// Places where vertices meet a solid.
struct ContactProgram::Meeting {
  Float4 fraction;  // share of the way
  Float4 lift;      // distance along the normal from there onto the surface [m]
  Vec3Lanes<Float4> normal;
  Float4 is_met;  // positive where it is
};

ContactProgram::ContactProgram(const LaneLayout& layout) : n_slots_(layout.n_slots) {
  left_over_.reserve(static_cast<std::size_t>(n_slots_));
}

void ContactProgram::begin_step(const ContactPass& contact, const LaneLayout& layout) {
  const Eigen::VectorXd& radii = contact.options().face_radii;
  face_squares_.assign(static_cast<std::size_t>(n_slots_), 0.0f);
  for (Eigen::Index i = 0; i < radii.size(); ++i) {
    const int slot = layout.places[static_cast<std::size_t>(i)].slot;
    face_squares_[static_cast<std::size_t>(slot)] = static_cast<float>(radii[i] * radii[i]);
  }
  knows_groups_ = false;
}

void ContactProgram::place(const SweptPlane& plane, const Vec3& origin, double extent,
                           Solid& solid) {
  const double level = plane.level - plane.normal.dot(origin);
  const double rounding = kRounding * (extent + std::abs(level));
  solid.kind = Kind::plane;
  solid.place = solid.middle = to_floats(plane.normal);
  solid.rounding = static_cast<float>(rounding);
  solid.size = static_cast<float>(level + rounding);
  solid.size_low = static_cast<float>(level + rounding - solid.size);
  solid.reach = static_cast<float>(level + 4 * rounding);
  solid.shift = to_floats(plane.shift);
}

void ContactProgram::place(const SweptSphere& ball, const Vec3& origin, double extent,
                           Solid& solid) {
  const Vec3 centre = ball.centre - origin;
  const double rounding = kRounding * (ball.radius + (solid.is_exact ? 0 : extent));
  solid.kind = Kind::ball;
  solid.place = to_floats(centre);
  solid.place_low = rounded_off_floats(centre);
  solid.middle = to_floats(centre - ball.shift / 2);
  solid.rounding = static_cast<float>(rounding);
  solid.size = static_cast<float>(ball.radius + rounding);
  solid.reach = static_cast<float>(ball.radius + 4 * kRounding * (extent + centre.norm()));
  solid.shift = to_floats(ball.shift);
}

// A vertex that begins at b and goes a straight way of length d meets a solid only where
// |b - c| <= r + d, with c the middle of the centre's own way of length s and r larger by s/2. What
// one solid makes of the way ends within d + 2 s of where it began. So no other one is met where
// |b - c| > r + d + 3 s.
void ContactProgram::place_solids(const ContactPass& contact, const Vec3& origin, double extent) {
  contact.outlines(outlines_);
  solids_.clear();
  near_.resize(outlines_.size());
  hits_.resize(outlines_.size());
  for (Slots& hits : hits_) hits.slots.resize(static_cast<std::size_t>(n_slots_) + 1);
  double longest_shift = 0;
  for (const ContactPass::Outline& outline : outlines_) {
    Solid solid{};
    solid.is_exact = outline.is_exact;
    solid.friction = static_cast<float>(outline.friction);
    std::visit([&](const auto& shape) { place(shape, origin, extent, solid); }, outline.shape);
    if (outline.cone != nullptr) {
      solid.is_exact = outline.is_exact && LaneCone::is_regular(*outline.cone, outline.radii);
      if (solid.is_exact) place_cone(contact, outline, origin, solid);
    }
    longest_shift = std::max(longest_shift, outline.longest_shift);
    solids_.push_back(solid);
  }
  for (Solid& solid : solids_)
    solid.reach += static_cast<float>(3 * (longest_shift + contact.drift().norm()));
  list_cones(contact);
}

void ContactProgram::list_cones(const ContactPass& contact) {
  const std::size_t n_before = cones_.size();
  others_.clear();
  cones_.clear();
  cone_shifts_.clear();
  for (std::size_t i = 0; i < solids_.size(); ++i) {
    if (solids_[i].kind != Kind::cone) {
      others_.push_back(static_cast<int>(i));
      continue;
    }
    cones_.push_back(static_cast<int>(i));
    cone_shifts_.push_back(static_cast<float>(outlines_[i].longest_shift));
  }
  if (cones_.empty()) return;
  if (!knows_groups_ || cones_.size() != n_before)
    freedom_.restart(n_slots_ / Float4::kLanes, static_cast<int>(cones_.size()));
  knows_groups_ = true;
  drift_ = to_floats(contact.drift());
  freedom_.begin_substep(cone_shifts_, static_cast<float>(contact.stretch()));
}

// A point at x, from the origin o, is carried to R (o + x) + t, seen from o.
void ContactProgram::place_cone(const ContactPass& contact, const ContactPass::Outline& outline,
                                const Vec3& origin, Solid& solid) {
  const SweptCone& cone = *outline.cone;
  const Mat3 turn = outline.carry.rotation - Mat3::Identity();
  const Vec3 centre = cone.origin - origin;
  const double rounding = kRounding * (cone.axis.length + cone.half_width + cone.axis.radius_at(0));
  solid.kind = Kind::cone;
  solid.place = to_floats(centre);
  solid.place_low = rounded_off_floats(centre);
  solid.rounding = static_cast<float>(rounding);
  solid.shift = to_floats(turn * origin + outline.carry.translation);
  for (int i = 0; i < 3; ++i) solid.turn[static_cast<std::size_t>(i)] = to_floats(turn.row(i));
  solid.cone = LaneCone(cone, outline.radii, contact.options().half_thickness + rounding);
}

inline int ContactProgram::near_lanes(const Solid& solid, const Vec3Lanes<Float4>& begin,
                                      Float4 length) {
  const Vec3Lanes<Float4> middle = all(solid.middle);
  const Float4 reach = Float4::all(solid.reach) + length;
  if (solid.kind == Kind::plane) return positive_lanes(reach - dot(middle, begin));
  const Vec3Lanes<Float4> apart = begin - middle;
  return positive_lanes(reach * reach - dot(apart, apart));
}

inline ContactProgram::Ways ContactProgram::ways(const Solid& solid, const Vec3Lanes<Float4>& begin,
                                                 const Vec3Lanes<Float4>& move,
                                                 const Vec3Lanes<Float4>& low) {
  Vec3Lanes<Float4> shift = all(solid.shift);
  if (solid.kind == Kind::cone)
    shift =
        shift + Vec3Lanes<Float4>{dot(all(solid.turn[0]), begin), dot(all(solid.turn[1]), begin),
                                  dot(all(solid.turn[2]), begin)};
  const Vec3Lanes<Float4> offset = low + shift;
  const Vec3Lanes<Float4> way = move - offset;
  if (solid.kind == Kind::plane) return {begin + offset, way, shift, offset};
  return {(begin - all(solid.place)) + (offset - all(solid.place_low)), way, shift, offset};
}

// The formulas are those of first_impact; a way ends inside, or begins outside, passes the nearest
// place on it, and that is inside. No root is taken to see that.
inline void ContactProgram::judge(const Solid& solid, const Ways& ways, Near& near) {
  const Vec3Lanes<Float4>& begin = ways.begin;
  const Vec3Lanes<Float4>& way = ways.way;
  const Float4 gap = gap_of(solid, begin);
  near.deep = positive_lanes(zero() - gap - Float4::all(kDeep * solid.rounding));
  if (solid.kind == Kind::plane) {
    near.hits = positive_lanes(zero() - dot(all(solid.place), way) - gap);
    return;
  }
  const Float4 excess = Float4::all(2 * solid.size) * gap;
  const Float4 approach = zero() - dot(begin, way);
  const Float4 square = dot(way, way);
  const Float4 ends_inside = approach + approach - square - excess;
  const Float4 passes = min(min(approach, approach * approach - square * excess),
                            min(approach - excess, gap - Float4::all(solid.rounding)));
  near.hits = positive_lanes(max(ends_inside, passes));
}

// The height is convex: a way that does not cross the tangent plane below its start meets nothing.
inline void ContactProgram::judge_cone(const Solid& solid, const Ways& ways, Float4 face_squares,
                                       Near& near) {
  const auto [height, normal] = solid.cone.above(ways.begin, solid.cone.radii(face_squares));
  near.deep = positive_lanes(zero() - height - Float4::all(kDeep * solid.rounding));
  near.hits = positive_lanes(zero() - height - dot(normal, ways.way));
  near.length = sqrt(dot(ways.way, ways.way));
  near.margin = height - near.length;
}

// Where a way begins within rounding of the surface, it meets it there. Every place that counts is
// within a few roundings of a ball's surface: its height, and the inverse of that, are known from
// its square to first order.
inline ContactProgram::Meeting ContactProgram::meeting(const Solid& solid, const Ways& ways) {
  const Vec3Lanes<Float4>& begin = ways.begin;
  const Vec3Lanes<Float4>& way = ways.way;
  const Float4 gap = gap_of(solid, begin);
  const Float4 is_apart = gap - Float4::all(solid.rounding);
  Meeting met;
  met.is_met = Float4::all(1);
  if (solid.kind == Kind::plane) {
    met.normal = all(solid.place);
    const Float4 falls = zero() - dot(met.normal, way);
    met.fraction = where_positive(is_apart, gap / falls);
    met.lift = met.fraction * falls - gap;
    return met;
  }
  const Float4 excess = Float4::all(2 * solid.size) * gap;
  const Float4 approach = zero() - dot(begin, way);
  const Float4 discriminant = approach * approach - dot(way, way) * excess;
  const Float4 nearer = approach + sqrt(max(discriminant, zero()));
  met.fraction =
      where_positive(is_apart, where_positive(nearer, min(excess / nearer, Float4::all(1))));
  const Vec3Lanes<Float4> place = begin + met.fraction * way;
  const Float4 inverse = Float4::all(1 / solid.size);
  met.lift = zero() - gap_of(solid, place);
  met.normal = (inverse * (Float4::all(1) + inverse * met.lift)) * place;
  return met;
}

// Newton's steps from the start never pass the surface. Where one leads beyond the way's end, the
// solid is not met.
inline ContactProgram::Meeting ContactProgram::cone_meeting(const Solid& solid, const Ways& ways,
                                                            Float4 face_squares) {
  const LaneCone::Radii radii = solid.cone.radii(face_squares);
  LaneCone::Height here = solid.cone.above(ways.begin, radii);
  const Float4 rounding = Float4::all(solid.rounding);
  Meeting met{zero(), zero(), here.normal, Float4::all(1)};
  for (int step = 0;; ++step) {
    const Float4 falls = zero() - dot(here.normal, ways.way);
    const Float4 is_apart = here.height - rounding;
    const Float4 is_reached = (Float4::all(1) - met.fraction) * falls - here.height;
    met.is_met = where_positive(met.is_met, max(is_reached, zero() - is_apart));
    if (step == kSteps) break;
    const Float4 goes_on = min(is_apart, is_reached);
    met.fraction = met.fraction + where_positive(goes_on, here.height / falls);
    here = solid.cone.above(ways.begin + met.fraction * ways.way, radii);
  }
  met.lift = max(zero() - here.height, zero());
  met.normal = here.normal;
  return met;
}

// With d the way relative to the solid, f the share of it at which it is met, and u the velocity
// times the substep relative to the point that is met: the vertex ends at f d + lift n +
// (1 - f) slip d_t, and goes on at slip u_t + max(u_n, 0) n. All are small, so that nothing is
// rounded to a place's last bit. A point q beyond the way's start, seen from a solid that turns by
// R, shifts by R^T q - q less.
void ContactProgram::respond(const Solid& solid, const LaneView& view,
                             const std::array<float*, 3>& rounded_off,
                             const LaneMembers& slots) const {
  const Vec3Lanes<Float4> move = gather(view.moves, slots);
  const Vec3Lanes<Float4> low = gather(rounded_off, slots);
  const Ways ways = ContactProgram::ways(solid, gather(view.begins, slots), move, low);
  const bool is_cone = solid.kind == Kind::cone;
  const Meeting met = is_cone
                          ? cone_meeting(solid, ways, Float4::gather(face_squares_.data(), slots))
                          : meeting(solid, ways);
  const Vec3Lanes<Float4>& way = ways.way;
  const Vec3Lanes<Float4> to_point = met.fraction * way + met.lift * met.normal;
  Vec3Lanes<Float4> shift = ways.shift;
  if (is_cone)
    shift = shift - (to_point.x * all(solid.turn[0]) + to_point.y * all(solid.turn[1]) +
                     to_point.z * all(solid.turn[2]));
  const Vec3Lanes<Float4> velocity = way + (ways.shift - shift);
  const Float4 normal_velocity = dot(met.normal, velocity);
  const Vec3Lanes<Float4> velocity_across = velocity - normal_velocity * met.normal;
  const Float4 limit = Float4::all(solid.friction) * max(zero() - normal_velocity, zero());
  const Float4 speed = sqrt(dot(velocity_across, velocity_across));
  const Float4 slip = where_positive(speed - limit, Float4::all(1) - limit / speed);
  const Vec3Lanes<Float4> across = way - dot(met.normal, way) * met.normal;
  const Vec3Lanes<Float4> goes_on =
      slip * velocity_across + max(normal_velocity, zero()) * met.normal + shift;
  const Vec3Lanes<Float4> to =
      ways.offset + to_point + ((Float4::all(1) - met.fraction) * slip) * across;
  scatter(choose(met.is_met, to, move), view.moves, slots);
  scatter(choose(met.is_met, to - goes_on, low), rounded_off, slots);
}

// Each lane is written, and stays where its vertex hits: as good as half of them do, in no order.
inline void ContactProgram::Slots::append(int lanes, int slot) {
  for (int lane = 0; lane < Float4::kLanes; ++lane) {
    slots[static_cast<std::size_t>(count)] = slot + lane;
    count += lanes >> lane & 1;
  }
}

// Where hits are no multiple of four, the last is responded to more than once, alike.
void ContactProgram::respond_to(const Slots& hits, const Solid& solid, const LaneView& view,
                                const std::array<float*, 3>& rounded_off) const {
  const auto at = [&](int i) {
    return hits.slots[static_cast<std::size_t>(std::min(i, hits.count - 1))];
  };
  for (int i = 0; i < hits.count; i += Float4::kLanes)
    respond(solid, view, rounded_off, {at(i), at(i + 1), at(i + 2), at(i + 3)});
}

/// Four vertices, and the longest way of those that move, beyond the drift [m].
struct ContactProgram::Group {
  int slot;
  Vec3Lanes<Float4> begin, move, low;
  Float4 moves;  // positive where a vertex does
  int moving;
  float way = 0;
};

inline void ContactProgram::look_at_others(const Group& group) {
  const Float4 length = sqrt(dot(group.move, group.move));
  for (const int index : others_) {
    const Solid& solid = solids_[static_cast<std::size_t>(index)];
    const int lanes = near_lanes(solid, group.begin, length);
    if (lanes == 0) continue;
    Near near{index, lanes, 0, 0, zero(), zero()};
    if (solid.is_exact) judge(solid, ways(solid, group.begin, group.move, group.low), near);
    near_[n_near_++] = near;
  }
}

// A ball about the cone is seen sooner than the cone.
void ContactProgram::look_at_cone(int cone, const Group& group, float further) {
  const int index = cones_[static_cast<std::size_t>(cone)];
  const Solid& solid = solids_[static_cast<std::size_t>(index)];
  const int group_index = group.slot / Float4::kLanes;
  const auto least = [&](Float4 height) {
    return lowest(choose(group.moves, height, Float4::all(kFar))) - kFreedomSlack;
  };
  const Vec3Lanes<Float4> apart = group.begin - all(solid.middle);
  const Float4 height = sqrt(dot(apart, apart)) - Float4::all(solid.size);
  freedom_.set(group_index, cone, least(height) - freedom_.spent(cone, group.way));
  if (freedom_.left(group_index, cone, group.way) > further) return;
  Near near{index, kAllLanes, 0, 0, zero(), zero()};
  judge_cone(solid, ways(solid, group.begin, group.move, group.low),
             Float4::load(face_squares_.data() + group.slot), near);
  freedom_.set(group_index, cone, least(near.margin));
  near_[n_near_++] = near;
}

// Looks at cones that may be met, then, where one is, at all that its answer may lead to.
void ContactProgram::look_at_cones(Group& group) {
  const Vec3Lanes<Float4> gone = group.move - group.low - all(drift_);
  group.way = -lowest(zero() - where_positive(group.moves, sqrt(dot(gone, gone))));
  const int index = group.slot / Float4::kLanes;
  const std::size_t n_before = n_near_;
  freedom_.spend(index, group.way, [&](int cone) { look_at_cone(cone, group, 0); });
  float further = 0;
  for (std::size_t i = n_before; i < n_near_; ++i)
    if ((near_[i].hits & group.moving) != 0)
      further = std::max(further, -lowest(zero() - near_[i].length));
  if (further == 0) return;
  for (int cone = 0; cone < static_cast<int>(cones_.size()); ++cone) {
    const auto is_this = [&](const Near& near) {
      return near.solid == cones_[static_cast<std::size_t>(cone)];
    };
    if (freedom_.left(index, cone, group.way) < further &&
        std::none_of(near_.begin(), near_.begin() + n_near_, is_this))
      look_at_cone(cone, group, further);
  }
  freedom_.spend_more(index, further);
}

// A vertex that hits one solid is answered for here if the answer cannot lead it into another: its
// end moves by no more than the length of its way, seen from the solid, so that it does not reach a
// cone whose height above its start is larger than that and its way. Every plane and ball in the
// list is within reach. Vertices that start deep inside, or beside a bound, are for ContactPass.
int ContactProgram::assign_hits(const Group& group) {
  const std::span<const Near> near = std::span<const Near>(near_).first(n_near_);
  const auto is_cone = [&](const Near& one) {
    return solids_[static_cast<std::size_t>(one.solid)].kind == Kind::cone;
  };
  int left_over = 0;
  for (const Near& one : near) {
    if (!solids_[static_cast<std::size_t>(one.solid)].is_exact) {
      left_over |= one.lanes & group.moving;
      continue;
    }
    const int hits = one.hits & one.lanes & group.moving;
    int not_alone = one.deep & one.lanes & group.moving;
    if (hits != 0) {
      for (const Near& other : near)
        if (&other != &one)
          not_alone |= hits & other.lanes &
                       (is_cone(one) && is_cone(other) ? positive_lanes(one.length - other.margin)
                                                       : kAllLanes);
      hits_[static_cast<std::size_t>(one.solid)].append(hits & ~not_alone, group.slot);
    }
    left_over |= not_alone;
  }
  return left_over;
}

const std::vector<int>& ContactProgram::resolve(const LaneView& view,
                                                const std::array<float*, 3>& rounded_off) {
  left_over_.clear();
  for (Slots& hits : hits_) hits.count = 0;
  for (int slot = 0; slot < n_slots_; slot += Float4::kLanes) {
    Group group{slot,
                load<Float4>(view.begins, slot),
                load<Float4>(view.moves, slot),
                load<Float4>(rounded_off, slot),
                Float4::load(view.inverse_masses + slot),
                0};
    group.moving = positive_lanes(group.moves);
    n_near_ = 0;
    look_at_others(group);
    if (!cones_.empty()) look_at_cones(group);
    if (n_near_ == 0) continue;
    const int lanes = assign_hits(group);
    for (int lane = 0; lane < Float4::kLanes; ++lane)
      if (lanes >> lane & 1) left_over_.push_back(slot + lane);
    if (lanes != 0 && !cones_.empty())
      freedom_.spend_more(slot / Float4::kLanes, std::numeric_limits<float>::infinity());
  }
  for (std::size_t i = 0; i < solids_.size(); ++i)
    respond_to(hits_[i], solids_[i], view, rounded_off);
  return left_over_;
}

}  // namespace pleat
