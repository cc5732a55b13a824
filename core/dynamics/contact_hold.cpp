#include "core/dynamics/contact_hold.h"

namespace pleat {

ContactHold::ContactHold(const ClothModel& model, double share)
    : contact_(*model.contact), share_(share), resistances_(model.masses) {
  held_.reserve(static_cast<std::size_t>(model.n_vertices()));
}

void ContactHold::set_resistances(const SystemMatrix& matrix, double mass_unit) {
  for (Eigen::Index i = 0; i < resistances_.size(); ++i)
    resistances_[i] = mass_unit / 3 * matrix.diagonal_trace(VertexId(i));
}

void ContactHold::choose(std::span<const ContactStage::Touch> touches,
                         const Positions& positions_begin) {
  held_.clear();
  for (const ContactStage::Touch& touch : touches) {
    const VertexId v = touch.vertex;
    const Mat3 held_parts =
        touch.sticks ? Mat3(Mat3::Identity()) : Mat3(touch.normal * touch.normal.transpose());
    held_.push_back({v, share_ * resistances_[v] * held_parts,
                     contact_.solid_velocity(touch, positions_begin.col(v))});
  }
}

void ContactHold::add(const Positions& velocities, SystemMatrix& matrix,
                      Eigen::Ref<Positions> rhs) const {
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
