#include "core/model/energy_ledger.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/model/hanging_vertices.h"

namespace pleat {
namespace {

/// The part of an impulse that a solid can give: it pushes, and rubs at most `friction` times as
/// much.
Vec3 coulomb_part(const Vec3& impulse, const Vec3& normal, double friction) {
  const double push = std::max(0.0, normal.dot(impulse));
  const Vec3 rub = impulse - normal.dot(impulse) * normal;
  const double size = rub.norm();
  const double share = size > friction * push ? friction * push / size : 1;
  return push * normal + share * rub;
}

}  // namespace

EnergyLedger::EnergyLedger(const ClothModel& model, const State& state)
    : model_(model),
      first_friction_loss_(friction_loss()),
      first_parts_(energy_parts(model, state)),
      parts_(first_parts_),
      largest_kinetic_energy_(first_parts_.kinetic) {
  take_vertices();
}

void EnergyLedger::take_vertices() {
  air_ = model_.air;
  friction_begin_ = model_.bend_friction;
  is_pinned_.resize(static_cast<std::size_t>(model_.n_vertices()));
  for (Loads* loads : {&begin_, &end_}) loads->forces.resize(3, model_.n_vertices());
  part_.resize(3, model_.n_vertices());
}

/// Replaces the moments of the end, which the model has, by those of the start.
void EnergyLedger::exchange_friction(const State& begin) {
  part_.setZero();
  model_.bend_friction->add_forces(begin.positions, part_);
  part_ = -part_;
  friction_begin_->add_forces(begin.positions, part_);
  pull_to_parents(model_.hanging, part_);
  begin_.forces += part_;
  friction_begin_ = model_.bend_friction;
}

void EnergyLedger::record_tear(const State& state) {
  const std::optional<BendFriction> friction = std::move(friction_begin_);
  take_vertices();
  EnergyParts torn = energy_parts(model_, state);
  if (friction) {  // the model may have moved on
    torn.elastic -= model_.bend_friction->energy(state.positions);
    friction_begin_->take_moments(*friction, state.positions);
    torn.elastic += friction_begin_->energy(state.positions);
  }
  works_.tears += torn.sum() - parts_.sum();
  parts_ = torn;
}

void EnergyLedger::evaluate(const State& state, double time, Loads& loads) {
  const auto& v = state.velocities;
  loads.forces.setZero();
  add_elastic_forces(model_, state.positions, loads.forces);
  add_gravity(model_, loads.forces);
  part_.setZero();
  add_damping_forces(model_, state.positions, v, part_);
  loads.damping_power = part_.cwiseProduct(v).sum();
  loads.forces += part_;
  loads.air_power = 0;
  if (air_) {
    part_.setZero();
    air_->set_time(time);
    air_->add_forces(state.positions, v, model_.hanging, part_);
    loads.air_power = part_.cwiseProduct(v).sum();
    loads.forces += part_;
  }
  pull_to_parents(model_.hanging, loads.forces);
}

/// m (v_end - v_begin) - h f with the mean force of both ends: what a pin or a solid must have
/// added [N s].
Vec3 EnergyLedger::missing_impulse(VertexId vertex, const State& begin, const State& end,
                                   double step) const {
  return model_.masses[vertex] * (end.velocities.col(vertex) - begin.velocities.col(vertex)) -
         step / 2 * (begin_.forces.col(vertex) + end_.forces.col(vertex));
}

void EnergyLedger::record_contact(const State& begin, const State& end, double time_end,
                                  double step, std::span<const char> on_cloth) {
  for (const ContactPass::Support& support : model_.contact->supports(end.positions, time_end)) {
    const VertexId v = support.vertex;
    if (is_pinned_[v] || (!on_cloth.empty() && on_cloth[v])) continue;
    const Vec3 impulse =
        coulomb_part(missing_impulse(v, begin, end, step), support.normal, support.friction);
    works_.contact += impulse.dot(begin.velocities.col(v) + end.velocities.col(v)) / 2;
  }
}

void EnergyLedger::record_cloth_contact(const State& begin, const State& end, double step,
                                        std::span<const char> on_cloth) {
  for (int i = 0; i < static_cast<int>(on_cloth.size()); ++i) {
    const VertexId v(i);
    if (!on_cloth[v] || is_pinned_[v] || model_.hangs(v)) continue;
    works_.cloth_contact +=
        missing_impulse(v, begin, end, step).dot(begin.velocities.col(i) + end.velocities.col(i)) /
        2;
  }
}

void EnergyLedger::record(const State& begin, const State& end, double time_end, double step,
                          std::span<const char> on_cloth) {
  PLEAT_CHECK(step > 0, "a step is positive");
  PLEAT_CHECK(
      begin.positions.cols() == model_.n_vertices() && end.positions.cols() == model_.n_vertices(),
      "a ledger keeps its number of vertices");
  evaluate(begin, time_end - step, begin_);
  evaluate(end, time_end, end_);
  if (friction_begin_) {
    exchange_friction(begin);
    works_.bend_friction = first_friction_loss_ - friction_loss();
  }
  works_.damping += step / 2 * (begin_.damping_power + end_.damping_power);
  works_.air += step / 2 * (begin_.air_power + end_.air_power);
  std::fill(is_pinned_.begin(), is_pinned_.end(), char{0});
  for (const Pin& pin : model_.pins) {
    is_pinned_[pin.vertex] = 1;
    works_.pins += missing_impulse(pin.vertex, begin, end, step)
                       .dot(begin.velocities.col(pin.vertex) + end.velocities.col(pin.vertex)) /
                   2;
  }
  if (model_.contact) record_contact(begin, end, time_end, step, on_cloth);
  record_cloth_contact(begin, end, step, on_cloth);
  parts_ = energy_parts(model_, end);
  largest_kinetic_energy_ = std::max(largest_kinetic_energy_, parts_.kinetic);
}

double EnergyLedger::drift() const { return parts_.sum() - first_parts_.sum() - works_.sum(); }

}  // namespace pleat
