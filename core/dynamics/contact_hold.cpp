#include "core/dynamics/contact_hold.h"

namespace pleat {

ContactHold::ContactHold(const ClothModel& model)
    : contact_(*model.contact), resistances_(model.masses) {
  held_.reserve(static_cast<std::size_t>(model.n_vertices()));
}

void ContactHold::add(const std::vector<ContactStage::Touch>& touches, const State& state,
                      SystemMatrix& matrix, Eigen::Ref<Positions> rhs) {
  held_.clear();
  for (Eigen::Index i = 0; i < rhs.cols(); ++i) {
    const VertexId vertex(static_cast<int>(i));
    resistances_[i] = matrix.diagonal_trace(vertex) / 3;
    const ContactStage::Touch& touch = touches[static_cast<std::size_t>(i)];
    if (!touch) continue;
    const Mat3 held_parts =
        touch.sticks ? Mat3(Mat3::Identity()) : Mat3(touch.normal * touch.normal.transpose());
    const Held held{vertex, resistances_[i] * held_parts,
                    contact_.solid_velocity(touch, state.positions.col(i))};
    matrix.add_diagonal(vertex, held.resistance);
    rhs.col(i) += held.resistance * (held.velocity - state.velocities.col(i));
    held_.push_back(held);
  }
}

void ContactHold::add_forces(const Positions& velocities, double h, Positions& forces) const {
  for (const Held& held : held_)
    forces.col(held.vertex) += held.resistance * (held.velocity - velocities.col(held.vertex)) / h;
}

}  // namespace pleat
