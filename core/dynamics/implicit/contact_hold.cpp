#include "core/dynamics/implicit/contact_hold.h"

#include <algorithm>

namespace pleat {
namespace {

/// Share of a vertex's weight that may pull it back to a solid for one substep: what leaves is
/// found to hundredths of a substep, and seldom solved for anew.
constexpr double kLeastPull = 0.1;

}  // namespace

ContactHold::ContactHold(const ClothModel& model, double share, Pressing pressing)
    : model_(model), share_(share), pressing_(pressing), resistances_(model.masses) {
  held_.reserve(static_cast<std::size_t>(model.n_vertices()));
  freed_.reserve(static_cast<std::size_t>(model.n_vertices()));
}

void ContactHold::set_resistances(const SystemMatrix& matrix, double mass_unit) {
  for (Eigen::Index i = 0; i < resistances_.size(); ++i)
    resistances_[i] = mass_unit / 3 * matrix.diagonal_trace(VertexId(i));
}

void ContactHold::choose(ContactMemory& memory, const State& begin, double h,
                         const SystemMatrix* matrix, double mass_unit) {
  memory.plan(begin, h, resistances_, share_, pressing_);
  held_.clear();
  for (ContactMemory::Plan& plan : memory.plans()) {
    const VertexId v = plan.touch.vertex;
    if (matrix) plan.resistance = mass_unit * matrix->diagonal_along(v, plan.normal);
    const Mat3 along = plan.normal * plan.normal.transpose();
    const Mat3 hold = along + plan.grip * (Mat3::Identity() - along);
    const Vec3 solid_velocity = model_.contact->solid_velocity(plan.touch, begin.positions.col(v));
    const double turn = std::max(plan.normal.dot(plan.velocity - solid_velocity), 0.0);
    held_.push_back({v, share_ * resistances_[v] * hold, plan.velocity, plan.normal,
                     model_.masses[v] / h * turn, memory.forces().col(v), !plan.touch.in_corner});
  }
}

std::span<const ContactHold::Held> ContactHold::free_pulled(ContactMemory& memory,
                                                            const Positions& velocities, double h) {
  freed_.clear();
  const double acceleration = kLeastPull * model_.gravity.norm();
  std::size_t n_left = 0;
  for (const Held& held : held_) {
    const Vec3 force =
        held.force + held.resistance * (held.velocity - velocities.col(held.vertex)) / h;
    if (held.may_be_freed && held.normal.dot(force) < -acceleration * model_.masses[held.vertex]) {
      freed_.push_back(held);
      memory.forces().col(held.vertex).setZero();
    } else {
      held_[n_left++] = held;
    }
  }
  held_.erase(held_.begin() + static_cast<std::ptrdiff_t>(n_left), held_.end());
  return freed_;
}

void ContactHold::add(const Positions& velocities, double h, SystemMatrix& matrix,
                      PositionsRef rhs) const {
  for (const Held& held : held_) {
    matrix.add_diagonal(held.vertex, held.resistance);
    rhs.col(held.vertex) += held.resistance * (held.velocity - velocities.col(held.vertex));
    rhs.col(held.vertex) += h * held.force;
  }
}

void ContactHold::take_out(std::span<const Held> freed, const Positions& velocities, double h,
                           SystemMatrix& matrix, PositionsRef rhs) const {
  for (const Held& held : freed) {
    matrix.add_diagonal(held.vertex, -held.resistance);
    rhs.col(held.vertex) -= held.resistance * (held.velocity - velocities.col(held.vertex));
    rhs.col(held.vertex) -= h * held.force;
  }
}

void ContactHold::add_forces(const Positions& velocities, double h, Positions& forces) const {
  for (const Held& held : held_)
    forces.col(held.vertex) += held.resistance * (held.velocity - velocities.col(held.vertex)) / h;
}

}  // namespace pleat
