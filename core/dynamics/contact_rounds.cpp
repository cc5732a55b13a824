#include "core/dynamics/contact_rounds.h"

#include <algorithm>

namespace pleat {
namespace {

Vec3 tangential(const Vec3& vector, const Vec3& normal) {
  return vector - normal.dot(vector) * normal;
}

}  // namespace

ContactRounds::ContactRounds(ClothModel& model) : model_(model) {
  const auto n_vertices = static_cast<std::size_t>(model.n_vertices());
  holds_.reserve(n_vertices);
  changes_.reserve(n_vertices);
}

void ContactRounds::refresh(const Eigen::VectorXd& diagonal, double h,
                            std::span<const char> is_free) {
  h_ = h;
  is_free_.assign(is_free.begin(), is_free.end());
  diagonal_ = stiffnesses_ = diagonal;
  resistances_ = h * h * diagonal;
  held_masses_ = held_masses_before_ = shares_ = Eigen::VectorXd::Zero(diagonal.size());
}

std::optional<ContactRounds::Hold> ContactRounds::hold(VertexId vertex, const Vec3& begin,
                                                       const Vec3& end, const Vec3& force) {
  const Vec3 let_go = end - force / stiffnesses_[vertex];
  Vec3 place = let_go;
  Vec3 velocity = (let_go - begin) / h_;
  const auto touch = model_.contact->resolve(vertex, begin, place, velocity);
  if (!touch) return std::nullopt;
  const Collider& solid = model_.contact->colliders()[static_cast<std::size_t>(touch->solid)];
  return Hold{vertex, touch->normal, solid.friction, touch->sticks, place - end, place - let_go};
}

void ContactRounds::find_held(const Positions& begin, const Positions& end,
                              const Positions& forces) {
  holds_.clear();
  changes_.clear();
  held_masses_.swap(held_masses_before_);
  held_masses_.setZero();
  for (int i = 0; i < model_.n_vertices(); ++i) {
    if (!is_free_[static_cast<std::size_t>(i)]) continue;
    const VertexId v(i);
    const Vec3 force = forces.col(i);
    if (const auto found = hold(v, begin.col(i), end.col(i), force)) {
      held_masses_[i] = model_.masses[i] / (h_ * h_);
      holds_.push_back(*found);
    } else if (!force.isZero(0)) {
      changes_.push_back({v, -force});
    }
  }
}

/// A held vertex is no softer than its mass, and none is stiffer than with its neighbours held.
void ContactRounds::set_stiffnesses(LinearSolver& solver) {
  solver.solve(held_masses_, shares_);
  stiffnesses_ = diagonal_;
  for (const Hold& held : holds_) {
    const int v = held.vertex;
    stiffnesses_[v] = held_masses_[v] / std::clamp(shares_[v], held_masses_[v] / diagonal_[v], 1.0);
  }
}

std::span<const ContactRounds::Change> ContactRounds::after_round(const Positions& begin,
                                                                  const Positions& end,
                                                                  const Positions& forces,
                                                                  LinearSolver& solver) {
  find_held(begin, end, forces);
  if (held_masses_ != held_masses_before_) set_stiffnesses(solver);
  for (const Hold& held : holds_) {
    const Vec3 force = forces.col(held.vertex);
    const Vec3 wanted = force + stiffnesses_[held.vertex] * held.lack;
    const double pressure = std::max(held.normal.dot(wanted), 0.0);
    const double limit = held.friction * pressure;
    Vec3 friction = tangential(held.sticks ? wanted : held.pull, held.normal);
    const double size = friction.norm();
    if (size > 0 && (size > limit || !held.sticks)) friction *= limit / size;
    changes_.push_back({held.vertex, pressure * held.normal + friction - force});
  }
  return changes_;
}

}  // namespace pleat
