#include "core/dynamics/contact_memory.h"

#include <algorithm>

namespace pleat {
namespace {

using Touch = ContactMemory::Touch;

/// The part of a vector across a unit normal.
Vec3 across(const Vec3& vector, const Vec3& normal) { return vector - normal.dot(vector) * normal; }

/// Share of the step with which friction is found. With all of it, friction of what hardly slides
/// points wherever rounding does, and a symmetric drape does not stay so.
constexpr double kFrictionShare = 0.15;

/// Adds the touches of vertices that are not among them yet; both in the order of the vertices.
void join_touches(std::span<const Touch> more, std::vector<Touch>& touches) {
  const auto is_before = [](const Touch& a, const Touch& b) { return a.vertex < b.vertex; };
  const auto n_known = static_cast<std::ptrdiff_t>(touches.size());
  for (const Touch& touch : more)
    if (!std::binary_search(touches.begin(), touches.begin() + n_known, touch, is_before))
      touches.push_back(touch);
  std::inplace_merge(touches.begin(), touches.begin() + n_known, touches.end(), is_before);
}

}  // namespace

ContactMemory::ContactMemory(const ClothModel& model, ContactForces wanted) : model_(model) {
  if (!model.contact) return;
  const auto n_vertices = static_cast<std::size_t>(model.n_vertices());
  is_exempt_.resize(n_vertices);
  if (wanted == ContactForces::forgotten ||
      model.contact->options().response != ContactResponse::resting)
    return;
  forces_ = Positions::Zero(3, model.n_vertices());
  touches_.reserve(n_vertices);
}

std::span<const char> ContactMemory::exempt() {
  std::fill(is_exempt_.begin(), is_exempt_.end(), char{0});
  for (const HangingVertex& h : model_.hanging) is_exempt_[h.vertex] = 1;
  for (const Pin& pin : model_.pins) is_exempt_[pin.vertex] = 1;
  return is_exempt_;
}

// A vertex that its force still presses has not left, though it may end above a round solid: it is
// brought down. With f the remembered force and r the vertex's resistance, the place and velocity
// without f are x - h^2 f/r (times travel_share) and v - h f/r: what the vertex would do were it
// let go. The contact acts on those, so it never pulls and stays inside Coulomb's cone. f then
// grows by the force m dv/h that makes of the solved velocity the corrected one, and vanishes where
// the vertex leaves. With r = m, that is of a free particle, it is the whole new force.
void ContactMemory::let_go(State& state, double h, const Eigen::VectorXd& resistances,
                           double travel_share) {
  if (!has_forces()) return;
  solved_velocities_ = state.velocities;
  for (const Touch& touch : touches_) {
    auto place = state.positions.col(touch.vertex);
    const Gap gap = model_.contact->gap_at_end(touch, place);
    if (gap.distance > 0 && gap.normal.dot(forces_.col(touch.vertex)) > 0)
      place -= gap.distance * gap.normal;
  }
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
    if (model_.hangs(VertexId(i))) continue;
    const Vec3 change = h / resistances[i] * forces_.col(i);
    state.velocities.col(i) -= change;
    state.positions.col(i) -= travel_share * h * change;
  }
}

double ContactMemory::friction_of(const Touch& touch) const {
  return model_.contact->colliders()[static_cast<std::size_t>(touch.solid)].friction;
}

void ContactMemory::forget_untouched() {
  Eigen::Index first_untouched = 0;
  const auto forget_until = [&](Eigen::Index end) {
    forces_.middleCols(first_untouched, end - first_untouched).setZero();
  };
  for (const Touch& touch : touches_) {
    forget_until(touch.vertex);
    first_untouched = touch.vertex + 1;
  }
  forget_until(forces_.cols());
}

// The solve holds a vertex that slips along the normal alone, so that it hears of friction only as
// a remembered force. That takes an augmented Lagrangian's step, with the resistance r, and is then
// held to Coulomb's cone. Once it would drive the vertex, the vertex sticks, if there is friction
// at all: without it the sign of what rounding leaves of it would decide.
void ContactMemory::add_friction(const Positions& positions_begin, const State& state, double h,
                                 const Eigen::VectorXd& resistances) {
  for (Touch& touch : touches_) {
    if (touch.sticks || touch.in_corner) continue;
    const VertexId v = touch.vertex;
    const Vec3 friction_before = across(forces_.col(v), touch.normal);
    const Vec3 slide =
        solved_velocities_.col(v) - model_.contact->solid_velocity(touch, positions_begin.col(v));
    touch.sticks = friction_of(touch) > 0 && friction_before.dot(slide) > 0;
    if (touch.sticks) continue;
    forces_.col(v) += std::max(kFrictionShare * resistances[v] - model_.masses[v], 0.0) / h *
                      across(state.velocities.col(v) - solved_velocities_.col(v), touch.normal);
  }
}

// All forces on a vertex in a corner are remembered as they are: they are not told apart.
void ContactMemory::add_forces(std::span<const Touch> touches, const Positions& velocities,
                               double h) {
  for (const Touch& touch : touches) {
    const VertexId v = touch.vertex;
    auto force = forces_.col(v);
    force += model_.masses[v] / h * (velocities.col(v) - solved_velocities_.col(v));
    if (touch.in_corner) continue;
    const double pressing = touch.normal.dot(force);
    const Vec3 rubbing = force - pressing * touch.normal;
    const double most = friction_of(touch) * std::max(pressing, 0.0);
    const double size = rubbing.norm();
    if (size > most) force = pressing * touch.normal + most / size * rubbing;
  }
}

void ContactMemory::remember(std::span<const Touch> touches, const Positions& positions_begin,
                             const State& state, double h, const Eigen::VectorXd& resistances) {
  is_touched_ = is_touched_ || !touches.empty();
  if (!has_forces()) return;
  touches_.assign(touches.begin(), touches.end());
  forget_untouched();
  add_friction(positions_begin, state, h, resistances);
  add_forces(touches_, state.velocities, h);
}

void ContactMemory::add(std::span<const Touch> touches, const State& state, double h) {
  is_touched_ = is_touched_ || !touches.empty();
  if (!has_forces()) return;
  add_forces(touches, state.velocities, h);
  join_touches(touches, touches_);
}

void ContactMemory::restart(const Positions& forces) {
  touches_.clear();
  forces_ = forces;
}

}  // namespace pleat
