#include "core/dynamics/implicit/contact_hold.h"

#include <algorithm>

namespace pleat {
namespace {

/// Share of a vertex's weight that may pull it back to a solid for one substep: what leaves is
/// found to hundredths of a substep, and seldom solved for anew.
constexpr double kLeastPull = 0.1;
/// Weights of a vertex beyond its friction by which one that sticks is torn loose.
constexpr double kLeastExcess = 1;

}  // namespace

ContactHold::ContactHold(const ClothModel& model, double share, Pressing pressing)
    : model_(model), share_(share), pressing_(pressing), resistances_(model.masses) {
  held_.reserve(static_cast<std::size_t>(model.n_vertices()));
  lost_.reserve(static_cast<std::size_t>(model.n_vertices()));
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
                     model_.masses[v] / h * turn, memory.forces().col(v), !plan.touch.in_corner,
                     plan.grip == 1 && !plan.touch.in_corner, memory.friction_of(plan.touch),
                     plan.owed});
  }
}

bool ContactHold::is_pulled(const Held& held, const Vec3& force) const {
  const double least = kLeastPull * model_.gravity.norm() * model_.masses[held.vertex];
  return held.may_be_freed && held.normal.dot(force) < -least;
}

ContactHold::Held ContactHold::freed(const Held& held, const Vec3& force) {
  const Vec3& n = held.normal;
  const double rubbing = (force - n.dot(force) * n).norm();
  const double share = rubbing > held.owed ? held.owed / rubbing : 1;
  Held freed = held;
  freed.may_be_freed = freed.sticks = false;
  freed.resistance = share * (held.resistance - n.dot(held.resistance * n) * n * n.transpose());
  freed.force.setZero();
  return freed;
}

// A hold yields by its own resistance alone, however much it is pulled: without this, a sheet that
// is stretched on its solid would come loose from its border by a row of vertices a substep.
bool ContactHold::is_torn_loose(const Held& held, const Vec3& force) const {
  const double pressing = held.normal.dot(force);
  const double rubbing = (force - pressing * held.normal).norm();
  const double least = kLeastExcess * model_.gravity.norm() * model_.masses[held.vertex];
  return held.sticks && rubbing > held.friction * std::max(pressing, 0.0) + least;
}

ContactHold::Held ContactHold::slipping(const Held& held, const Vec3& force) {
  const Vec3& n = held.normal;
  const double pressing = n.dot(force);
  const Vec3 way = (force - pressing * n).normalized();
  Held slipping = held;
  slipping.sticks = false;
  slipping.owed = 0;
  slipping.force = n.dot(held.force) * n + held.friction * std::max(pressing, 0.0) * way;
  slipping.resistance = n.dot(held.resistance * n) * n * n.transpose();
  return slipping;
}

std::span<const ContactHold::Held> ContactHold::let_loose(ContactMemory& memory,
                                                          const Positions& velocities, double h) {
  lost_.clear();
  for (Held& held : held_) {
    const Vec3 force =
        held.force + held.resistance * (held.velocity - velocities.col(held.vertex)) / h;
    const bool is_freed = is_pulled(held, force);
    if (!is_freed && !is_torn_loose(held, force)) continue;
    if (is_freed)
      memory.let_leave(held.vertex);
    else
      memory.let_slip(held.vertex);
    Held lost = held;
    held = is_freed ? freed(held, force) : slipping(held, force);
    lost.resistance -= held.resistance;
    lost.force -= held.force;
    lost.leaves = is_freed;
    lost_.push_back(lost);
    memory.forces().col(held.vertex) = held.force;
  }
  return lost_;
}

void ContactHold::add(const Positions& velocities, double h, SystemMatrix& matrix,
                      PositionsRef rhs) const {
  for (const Held& held : held_) {
    matrix.add_diagonal(held.vertex, held.resistance);
    rhs.col(held.vertex) += held.resistance * (held.velocity - velocities.col(held.vertex));
    rhs.col(held.vertex) += h * held.force;
  }
}

void ContactHold::take_out(std::span<const Held> lost, const Positions& velocities, double h,
                           SystemMatrix& matrix, PositionsRef rhs) const {
  for (const Held& held : lost) {
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
