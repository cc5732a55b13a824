#include "core/dynamics/xpbd/contact_program.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "core/dynamics/xpbd/simd4.h"

namespace pleat {
namespace {

/// What a place is known to in single precision, in shares of the lengths that it is made from.
constexpr double kRounding = 4e-7;

/// Vertices deeper inside than so many roundings did not come there by rounding.
constexpr float kDeep = 8;

constexpr float kNever = std::numeric_limits<float>::infinity();

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

}  // namespace

struct ContactProgram::Ways {
  Vec3Lanes<Float4> begin;  // from the centre; of a plane from the origin
  Vec3Lanes<Float4> way;
};

/// Where vertices meet a solid, in each lane where `hits` is positive.
struct ContactProgram::Meeting {
  Float4 hits;
  Float4 gap;       // of the begin above the surface [m]
  Float4 fraction;  // of the way
  Float4 lift;      // along the normal, from there onto the surface [m]
  Vec3Lanes<Float4> normal;
};

ContactProgram::ContactProgram(const LaneLayout& layout) : n_slots_(layout.n_slots) {
  left_over_.reserve(static_cast<std::size_t>(n_slots_));
}

// A vertex whose straight way of length d about its middle m meets a solid has |m - c| <= r + d/2,
// with c the middle of the centre's own way of length s and r larger by s/2. What one solid makes
// of the way ends within d + 2 s of where it began. So no other one is met where |m - c| > r + 2 d
// + 3 s.
void ContactProgram::place_solids(const ContactStage& contact, const Vec3& origin, double extent) {
  contact.outlines(outlines_);
  solids_.clear();
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

/// Positive where a vertex may meet the solid.
Float4 ContactProgram::reached(const Solid& solid, const LaneView& view, int slot) {
  const Vec3Lanes<Float4> way = load<Float4>(view.moves, slot);
  const Vec3Lanes<Float4> middle = load<Float4>(view.begins, slot) + Float4::all(0.5f) * way;
  const Float4 reach = Float4::all(solid.reach) + Float4::all(2) * sqrt(dot(way, way));
  const Vec3Lanes<Float4> place = all(solid.middle);
  if (!solid.is_ball) return reach - dot(place, middle);
  const Vec3Lanes<Float4> apart = middle - place;
  return reach * reach - dot(apart, apart);
}

// The formulas are those of first_impact. Where a way begins within rounding of the surface, it
// meets it there.
ContactProgram::Meeting ContactProgram::meeting(const Solid& solid, const Ways& ways) {
  const auto& [begin, way] = ways;
  const Float4 band = Float4::all(solid.rounding);
  const Float4 size = Float4::all(solid.size);
  Meeting met;
  if (!solid.is_ball) {
    met.normal = all(solid.place);
    met.gap = dot(met.normal, begin) - size - Float4::all(solid.size_low);
    const Float4 falls = zero() - dot(met.normal, way);
    met.hits = falls - met.gap;
    met.fraction = where_positive(met.gap - band, met.gap / falls);
    met.lift = met.fraction * falls - met.gap;
    return met;
  }
  const Float4 distance = sqrt(dot(begin, begin));
  met.gap = distance - size;
  const Float4 excess = met.gap * (distance + size);
  const Float4 approach = zero() - dot(begin, way);
  const Float4 discriminant = approach * approach - dot(way, way) * excess;
  const Float4 nearer = approach + sqrt(max(discriminant, zero()));
  const Vec3Lanes<Float4> end = begin + way;
  const Float4 ends_inside = size - sqrt(dot(end, end));
  const Float4 passes = min(min(approach, discriminant), min(nearer - excess, met.gap - band));
  met.hits = max(ends_inside, passes);
  met.fraction =
      where_positive(met.gap - band, where_positive(nearer, min(excess / nearer, Float4::all(1))));
  const Vec3Lanes<Float4> place = begin + met.fraction * way;
  const Float4 height = sqrt(dot(place, place));
  met.normal = (Float4::all(1) / height) * place;
  met.lift = size - height;
  return met;
}

// With d the way and v = d the velocity times the substep, both relative to the solid, and f the
// share of the way at which it is met: the vertex ends at f d + lift n + (1 - f) slip d_t, and goes
// on at slip d_t + max(d_n, 0) n. All are small, so that nothing is rounded to a place's last bit.
// Returns the lanes of vertices that begin deep inside: they are left as they are.
int ContactProgram::meet(const Solid& solid, const LaneView& view,
                         const std::array<float*, 3>& rounded_off, int slot) {
  const Vec3Lanes<Float4> move = load<Float4>(view.moves, slot);
  const Vec3Lanes<Float4> low = load<Float4>(rounded_off, slot);
  const Vec3Lanes<Float4> shift = all(solid.shift);
  Ways ways{load<Float4>(view.begins, slot), move - low - shift};
  ways.begin = solid.is_ball
                   ? (ways.begin - all(solid.place)) + (low + shift - all(solid.place_low))
                   : ways.begin + (low + shift);
  Meeting met = meeting(solid, ways);
  const Float4 is_moving = Float4::load(view.inverse_masses + slot);
  const Float4 depth = zero() - met.gap - Float4::all(kDeep * solid.rounding);
  const Float4 hits =
      where_positive(is_moving, met.hits) - where_positive(depth, Float4::all(kNever));

  const Vec3Lanes<Float4>& way = ways.way;
  const Float4 normal_way = dot(met.normal, way);
  const Vec3Lanes<Float4> across = way - normal_way * met.normal;
  const Float4 limit = Float4::all(solid.friction) * max(zero() - normal_way, zero());
  const Float4 length = sqrt(dot(across, across));
  const Float4 slip = where_positive(length - limit, Float4::all(1) - limit / length);
  const Vec3Lanes<Float4> goes_on = slip * across + max(normal_way, zero()) * met.normal + shift;
  const Vec3Lanes<Float4> to = low + shift + met.fraction * way + met.lift * met.normal +
                               ((Float4::all(1) - met.fraction) * slip) * across;
  const auto keep = [&](const Vec3Lanes<Float4>& from, const Vec3Lanes<Float4>& changed) {
    return Vec3Lanes<Float4>{from.x + where_positive(hits, changed.x - from.x),
                             from.y + where_positive(hits, changed.y - from.y),
                             from.z + where_positive(hits, changed.z - from.z)};
  };
  store(keep(move, to), view.moves, slot);
  store(keep(low, to - goes_on), rounded_off, slot);
  return positive_lanes(where_positive(is_moving, depth));
}

const std::vector<int>& ContactProgram::resolve(const LaneView& view,
                                                const std::array<float*, 3>& rounded_off) {
  left_over_.clear();
  for (int slot = 0; slot < n_slots_; slot += Float4::kLanes) {
    const Solid* met = nullptr;
    int lanes = 0;
    int n_met = 0;
    for (const Solid& solid : solids_) {
      const int near = positive_lanes(reached(solid, view, slot));
      if (near == 0) continue;
      ++n_met;
      met = &solid;
      lanes |= near;
    }
    if (lanes == 0) continue;
    if (n_met == 1 && met->is_exact) lanes = meet(*met, view, rounded_off, slot);
    for (int lane = 0; lane < Float4::kLanes; ++lane)
      if ((lanes >> lane & 1) != 0 && view.inverse_masses[slot + lane] > 0)
        left_over_.push_back(slot + lane);
  }
  return left_over_;
}

}  // namespace pleat
