#include "core/dynamics/implicit/contact_hold.h"

namespace pleat {

ContactHold::ContactHold(const ClothModel& model, double share)
    : contact_(*model.contact), share_(share), resistances_(model.masses) {
  held_.reserve(static_cast<std::size_t>(model.n_vertices()));
}

void ContactHold::set_resistances(const SystemMatrix& matrix, double mass_unit) {
  for (Eigen::Index i = 0; i < resistances_.size(); ++i)
    resistances_[i] = mass_unit / 3 * matrix.diagonal_trace(VertexId(i));
}

void ContactHold::choose(std::span<const ContactPass::Touch> touches, const State& begin,
                         double h) {
  held_.clear();
  for (const ContactPass::Touch& touch : touches) {
    const VertexId v = touch.vertex;
    const double resistance = share_ * resistances_[v];
    const Vec3 solid_velocity = contact_.solid_velocity(touch, begin.positions.col(v));
    if (touch.sticks) {
      held_.push_back({v, resistance * Mat3::Identity(), solid_velocity});
      continue;
    }
    // Round solids fall away below the tangent: held along it, a vertex would be lifted off.
    const Vec3 slide = begin.velocities.col(v) - solid_velocity;
    const Vec3 along = slide - touch.normal * touch.normal.dot(slide);
    const Gap gap =
        contact_.gap_at_end(touch, begin.positions.col(v) + h * (solid_velocity + along));
    const double approach = gap.normal.dot(along) - gap.distance / h;
    held_.push_back({v, resistance * gap.normal * gap.normal.transpose(),
                     solid_velocity + approach * gap.normal});
  }
}

void ContactHold::add(const Positions& velocities, SystemMatrix& matrix, PositionsRef rhs) const {
  for (const Held& held : held_) {
    matrix.add_diagonal(held.vertex, held.resistance);
    rhs.col(held.vertex) += held.resistance * (held.velocity - velocities.col(held.vertex));
  }
}

void ContactHold::add_forces(const Positions& velocities, double h, Positions& forces) const {
  for (const Held& held : held_)
    forces.col(held.vertex) += held.resistance * (held.velocity - velocities.col(held.vertex)) / h;
}

}  // namespace pleat
