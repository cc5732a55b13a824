#include "core/dynamics/contact_hold.h"

namespace pleat {

ContactHold::ContactHold(const ClothModel& model)
    : contact_(*model.contact), resistances_(model.masses) {
  held_.reserve(static_cast<std::size_t>(model.n_vertices()));
}

void ContactHold::add(std::span<const ContactStage::Touch> touches, const State& state,
                      SystemMatrix& matrix, Eigen::Ref<Positions> rhs) {
  for (Eigen::Index i = 0; i < rhs.cols(); ++i)
    resistances_[i] = matrix.diagonal_trace(VertexId(i)) / 3;
  held_.clear();
  for (const ContactStage::Touch& touch : touches) {
    const VertexId v = touch.vertex;
    const Mat3 held_parts =
        touch.sticks ? Mat3(Mat3::Identity()) : Mat3(touch.normal * touch.normal.transpose());
    const Held held{v, resistances_[v] * held_parts,
                    contact_.solid_velocity(touch, state.positions.col(v))};
    matrix.add_diagonal(v, held.resistance);
    rhs.col(v) += held.resistance * (held.velocity - state.velocities.col(v));
    held_.push_back(held);
  }
}

void ContactHold::add_forces(const Positions& velocities, double h, Positions& forces) const {
  for (const Held& held : held_)
    forces.col(held.vertex) += held.resistance * (held.velocity - velocities.col(held.vertex)) / h;
}

}  // namespace pleat
