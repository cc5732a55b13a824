#include "core/dynamics/xpbd/contact_program.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "core/dynamics/xpbd/simd4.h"

namespace pleat {
namespace {

/// What a place is known to in single precision, in shares of the lengths that it is made from.
constexpr double kRounding = 4e-7;

/// Vertices deeper inside than so many roundings did not come there by rounding.
constexpr float kDeep = 8;

/// In place of a solid's index.
constexpr int kSeveral = -1;

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

}  // namespace

/// Of places above a solid's surface [m]; of a ball to first order.
inline Float4 ContactProgram::gap_of(const Solid& solid, const Vec3Lanes<Float4>& place) {
  const Float4 size = Float4::all(solid.size);
  if (!solid.is_ball) return dot(all(solid.place), place) - size - Float4::all(solid.size_low);
  return Float4::all(0.5f / solid.size) * (dot(place, place) - size * size);
}

struct ContactProgram::Ways {
  Vec3Lanes<Float4> begin;  // from the centre; of a plane from the origin
  Vec3Lanes<Float4> way;
  Vec3Lanes<Float4> offset;  // of the begin above from the vertex's rounded begin
};

/// Where vertices meet a solid.
struct ContactProgram::Meeting {
  Float4 fraction;  // of the way
  Float4 lift;      // along the normal, from there onto the surface [m]
  Vec3Lanes<Float4> normal;
};

ContactProgram::ContactProgram(const LaneLayout& layout)
    : n_slots_(layout.n_slots), near_(static_cast<std::size_t>(n_slots_ / Float4::kLanes)) {
  left_over_.reserve(static_cast<std::size_t>(n_slots_));
}

// A vertex that begins at b and goes a straight way of length d meets a solid only where
// |b - c| <= r + d, with c the middle of the centre's own way of length s and r larger by s/2. What
// one solid makes of the way ends within d + 2 s of where it began. So no other one is met where
// |b - c| > r + d + 3 s.
void ContactProgram::place_solids(const ContactStage& contact, const Vec3& origin, double extent) {
  contact.outlines(outlines_);
  solids_.clear();
  hits_.resize(outlines_.size());
  for (Slots& hits : hits_) hits.slots.resize(static_cast<std::size_t>(n_slots_) + 1);
  double longest_shift = 0;
  for (const ContactStage::Outline& outline : outlines_) {
    Solid solid{};
    solid.is_exact = outline.is_exact;
    solid.friction = static_cast<float>(outline.friction);
    Vec3 shift;
    if (const auto* ball = std::get_if<SweptSphere>(&outline.shape)) {
      const Vec3 centre = ball->centre - origin;
      const double rounding = kRounding * (ball->radius + (solid.is_exact ? 0 : extent));
      shift = ball->shift;
      solid.is_ball = true;
      solid.place = to_floats(centre);
      solid.place_low = rounded_off_floats(centre);
      solid.middle = to_floats(centre - shift / 2);
      solid.rounding = static_cast<float>(rounding);
      solid.size = static_cast<float>(ball->radius + rounding);
      solid.reach = static_cast<float>(ball->radius + 4 * kRounding * (extent + centre.norm()));
    } else {
      const auto& plane = std::get<SweptPlane>(outline.shape);
      const double level = plane.level - plane.normal.dot(origin);
      const double rounding = kRounding * (extent + std::abs(level));
      shift = plane.shift;
      solid.place = solid.middle = to_floats(plane.normal);
      solid.rounding = static_cast<float>(rounding);
      solid.size = static_cast<float>(level + rounding);
      solid.size_low = static_cast<float>(level + rounding - solid.size);
      solid.reach = static_cast<float>(level + 4 * rounding);
    }
    solid.shift = to_floats(shift);
    longest_shift = std::max(longest_shift, shift.norm());
    solids_.push_back(solid);
  }
  for (Solid& solid : solids_) solid.reach += static_cast<float>(3 * longest_shift);
}

void ContactProgram::find_near(const Solid& solid, int index, const LaneView& view) {
  const Vec3Lanes<Float4> middle = all(solid.middle);
  const Float4 least = Float4::all(solid.reach);
  Nearness* near = near_.data();
  for (int slot = 0; slot < n_slots_; slot += Float4::kLanes, ++near) {
    const Vec3Lanes<Float4> way = load<Float4>(view.moves, slot);
    const Vec3Lanes<Float4> begin = load<Float4>(view.begins, slot);
    const Float4 reach = least + sqrt(dot(way, way));
    Float4 is_near;
    if (solid.is_ball) {
      const Vec3Lanes<Float4> apart = begin - middle;
      is_near = reach * reach - dot(apart, apart);
    } else {
      is_near = reach - dot(middle, begin);
    }
    const int lanes = positive_lanes(is_near);
    if (lanes == 0) continue;
    near->solid = near->lanes == 0 ? index : kSeveral;
    near->lanes |= lanes;
  }
}

inline ContactProgram::Ways ContactProgram::ways(const Solid& solid, const Vec3Lanes<Float4>& begin,
                                                 const Vec3Lanes<Float4>& move,
                                                 const Vec3Lanes<Float4>& low) {
  const Vec3Lanes<Float4> shift = all(solid.shift);
  const Vec3Lanes<Float4> offset = low + shift;
  const Vec3Lanes<Float4> way = move - offset;
  if (!solid.is_ball) return {begin + offset, way, offset};
  return {(begin - all(solid.place)) + (offset - all(solid.place_low)), way, offset};
}

// The formulas are those of first_impact; a way ends inside, or begins outside, passes the nearest
// place on it, and that is inside. No root is taken to see that.
inline ContactProgram::Verdict ContactProgram::verdict(const Solid& solid, const Ways& ways) {
  const auto& [begin, way, offset] = ways;
  const Float4 gap = gap_of(solid, begin);
  const Float4 is_deep = zero() - gap - Float4::all(kDeep * solid.rounding);
  if (!solid.is_ball) return {zero() - dot(all(solid.place), way) - gap, is_deep};
  const Float4 excess = Float4::all(2 * solid.size) * gap;
  const Float4 approach = zero() - dot(begin, way);
  const Float4 square = dot(way, way);
  const Float4 ends_inside = approach + approach - square - excess;
  const Float4 passes = min(min(approach, approach * approach - square * excess),
                            min(approach - excess, gap - Float4::all(solid.rounding)));
  return {max(ends_inside, passes), is_deep};
}

// Where a way begins within rounding of the surface, it meets it there. Every place that counts is
// within a few roundings of a ball's surface: its height, and the inverse of that, are known from
// its square to first order.
inline ContactProgram::Meeting ContactProgram::meeting(const Solid& solid, const Ways& ways) {
  const auto& [begin, way, offset] = ways;
  const Float4 gap = gap_of(solid, begin);
  const Float4 is_apart = gap - Float4::all(solid.rounding);
  Meeting met;
  if (!solid.is_ball) {
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

// With d the way and v = d the velocity times the substep, both relative to the solid, and f the
// share of the way at which it is met: the vertex ends at f d + lift n + (1 - f) slip d_t, and goes
// on at slip d_t + max(d_n, 0) n. All are small, so that nothing is rounded to a place's last bit.
void ContactProgram::respond(const Solid& solid, const LaneView& view,
                             const std::array<float*, 3>& rounded_off, const LaneMembers& slots) {
  const Ways ways = ContactProgram::ways(solid, gather(view.begins, slots),
                                         gather(view.moves, slots), gather(rounded_off, slots));
  const Meeting met = meeting(solid, ways);
  const Vec3Lanes<Float4>& way = ways.way;
  const Float4 normal_way = dot(met.normal, way);
  const Vec3Lanes<Float4> across = way - normal_way * met.normal;
  const Float4 limit = Float4::all(solid.friction) * max(zero() - normal_way, zero());
  const Float4 length = sqrt(dot(across, across));
  const Float4 slip = where_positive(length - limit, Float4::all(1) - limit / length);
  const Vec3Lanes<Float4> goes_on =
      slip * across + max(normal_way, zero()) * met.normal + all(solid.shift);
  const Vec3Lanes<Float4> to = ways.offset + met.fraction * way + met.lift * met.normal +
                               ((Float4::all(1) - met.fraction) * slip) * across;
  scatter(to, view.moves, slots);
  scatter(to - goes_on, rounded_off, slots);
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
                                const std::array<float*, 3>& rounded_off) {
  const auto at = [&](int i) {
    return hits.slots[static_cast<std::size_t>(std::min(i, hits.count - 1))];
  };
  for (int i = 0; i < hits.count; i += Float4::kLanes)
    respond(solid, view, rounded_off, {at(i), at(i + 1), at(i + 2), at(i + 3)});
}

const std::vector<int>& ContactProgram::resolve(const LaneView& view,
                                                const std::array<float*, 3>& rounded_off) {
  left_over_.clear();
  for (Slots& hits : hits_) hits.count = 0;
  std::fill(near_.begin(), near_.end(), Nearness{});
  for (std::size_t i = 0; i < solids_.size(); ++i) find_near(solids_[i], static_cast<int>(i), view);
  for (int slot = 0; slot < n_slots_; slot += Float4::kLanes) {
    const Nearness& near = near_[static_cast<std::size_t>(slot / Float4::kLanes)];
    if (near.lanes == 0) continue;
    int lanes = near.lanes;
    const int moving = positive_lanes(Float4::load(view.inverse_masses + slot));
    if (near.solid != kSeveral && solids_[static_cast<std::size_t>(near.solid)].is_exact) {
      const Solid& solid = solids_[static_cast<std::size_t>(near.solid)];
      const auto [hits, is_deep] =
          verdict(solid, ways(solid, load<Float4>(view.begins, slot),
                              load<Float4>(view.moves, slot), load<Float4>(rounded_off, slot)));
      lanes = positive_lanes(is_deep);
      hits_[static_cast<std::size_t>(near.solid)].append(positive_lanes(hits) & moving & ~lanes,
                                                         slot);
    }
    for (int lane = 0; lane < Float4::kLanes; ++lane)
      if ((lanes & moving) >> lane & 1) left_over_.push_back(slot + lane);
  }
  for (std::size_t i = 0; i < solids_.size(); ++i)
    respond_to(hits_[i], solids_[i], view, rounded_off);
  return left_over_;
}

}  // namespace pleat
