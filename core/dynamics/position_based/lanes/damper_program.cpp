#include "core/dynamics/position_based/lanes/damper_program.h"

#include "core/dynamics/position_based/lanes/spring_order.h"
#include "core/dynamics/position_based/spring_law.h"

namespace pleat {
namespace {

// Impulse p of one damper, by backward Euler for it alone. It acts on P u, which is u = v_a - v_b
// or its part along d = x_a - x_b; w is w_a + w_b:
//   p = -h c P u',   u' = u + w p,   so   p = -h c/(1 + h c w) P u.
// P u' = P u/(1 + h c w): no damper turns motion round, and kinetic energy falls by
// |P u|^2/(2 w) (1 - 1/(1 + h c w)^2). All of it times h here, velocities and impulse.
template <DampingDirection direction, class Lanes>
Vec3Lanes<Lanes> impulse_of(const Vec3Lanes<Lanes>& d, const Vec3Lanes<Lanes>& motion, Lanes w,
                            Lanes strength) {
  const Lanes stiffening = Lanes::all(1.0f) + strength * w;
  if constexpr (direction == DampingDirection::isotropic)
    return (Lanes::all(0.0f) - strength / stiffening) * motion;
  const Lanes square = max(dot(d, d), Lanes::all(kTinySquare));
  return (Lanes::all(0.0f) - strength * dot(d, motion) / (stiffening * square)) * d;
}

}  // namespace

DamperProgram::DamperProgram(const ClothModel& model, const LaneLayout& layout, double h)
    : direction_(model.damping_direction) {
  const double per_damping = h / model.masses.mean();
  const auto strength_of = [&](int s) {
    return static_cast<float>(per_damping * model.springs[static_cast<std::size_t>(s)].damping);
  };
  const FreeCombinations in_free_vertices(model.n_vertices(), model.hanging);
  std::vector<int> in_lanes;
  for (std::size_t i = 0; i < model.springs.size(); ++i) {
    if (!(model.springs[i].damping > 0)) continue;
    const auto s = static_cast<int>(i);
    const std::array ends{model.springs[i].a, model.springs[i].b};
    if (!any_hangs(model, ends)) {
      in_lanes.push_back(s);
      continue;
    }
    constexpr std::array<double, 2> kDifference = {1, -1};
    hanging_.push_back({sum_in_slots(in_free_vertices(ends, kDifference), layout), strength_of(s)});
  }
  for (const LaneOperation& operation : order_springs(model, layout, in_lanes).operations) {
    append_to_stretches(stretches_, static_cast<int>(operations_.size()), operation.first_slots, 2);
    Operation braking{operation.first_slots[0], operation.first_slots[1], {}};
    for (std::size_t lane = 0; lane < operation.members.size(); ++lane)
      if (operation.members[lane] >= 0)
        braking.strengths[lane] = strength_of(operation.members[lane]);
    operations_.push_back(braking);
    members_.push_back(operation.members);
  }
}

template <DampingDirection direction>
void DamperProgram::brake_in_lanes(const LaneView& view,
                                   const std::array<float*, 3>& rounded_off) const {
  const LaneView v = view;
  const std::array<float*, 3> lows = rounded_off;
  const Operation* const operations = operations_.data();
  for_each_operation(stretches_, members_, [=](int index, int lane, auto lanes) {
    using Lanes = decltype(lanes);
    const int a = operations[index].a + lane;
    const int b = operations[index].b + lane;
    const Vec3Lanes<Lanes> change = load<Lanes>(v.moves, a) - load<Lanes>(v.moves, b);
    const Vec3Lanes<Lanes> low_a = load<Lanes>(lows, a);
    const Vec3Lanes<Lanes> low_b = load<Lanes>(lows, b);
    const Vec3Lanes<Lanes> d = (load<Lanes>(v.begins, a) - load<Lanes>(v.begins, b)) + change;
    const Lanes w_a = Lanes::load(v.inverse_masses + a);
    const Lanes w_b = Lanes::load(v.inverse_masses + b);
    const Vec3Lanes<Lanes> impulse =
        impulse_of<direction>(d, change - (low_a - low_b), w_a + w_b,
                              Lanes::load(operations[index].strengths.data() + lane));
    store(low_a - w_a * impulse, lows, a);
    store(low_b + w_b * impulse, lows, b);
  });
}

template <DampingDirection direction>
void DamperProgram::brake_hanging(const LaneView& v,
                                  const std::array<float*, 3>& rounded_off) const {
  for (const auto& [sum, strength] : hanging_) {
    const Vec3Lanes<Float1> change = value(sum, v.moves);
    const Vec3Lanes<Float1> impulse =
        impulse_of<direction>(value(sum, v.begins) + change, change - value(sum, rounded_off),
                              inverse_mass_of(sum, v.inverse_masses), Float1{strength});
    move_by(sum, Float1{-1} * impulse, v.inverse_masses, rounded_off);
  }
}

void DamperProgram::brake(const LaneView& view, const std::array<float*, 3>& rounded_off) const {
  if (direction_ == DampingDirection::isotropic) {
    brake_in_lanes<DampingDirection::isotropic>(view, rounded_off);
    brake_hanging<DampingDirection::isotropic>(view, rounded_off);
  } else {
    brake_in_lanes<DampingDirection::along_spring>(view, rounded_off);
    brake_hanging<DampingDirection::along_spring>(view, rounded_off);
  }
}

}  // namespace pleat
