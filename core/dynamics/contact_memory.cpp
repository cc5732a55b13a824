#include "core/dynamics/contact_memory.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace pleat {
namespace {

using Touch = ContactMemory::Touch;

/// The part of a vector across a unit normal.
Vec3 across(const Vec3& vector, const Vec3& normal) { return vector - normal.dot(vector) * normal; }

/// A vector as the shortest turn from one unit normal to another takes it.
Vec3 turned(const Vec3& vector, const Vec3& from, const Vec3& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to) * vector;
}

/// A vector, made shorter where it is longer than that.
Vec3 at_most(const Vec3& vector, double length) {
  const double size = vector.norm();
  return size > length ? Vec3(length / size * vector) : vector;
}

/// A force within Coulomb's cone about a unit normal.
Vec3 in_cone(const Vec3& force, const Vec3& normal, double friction) {
  const double pressing = normal.dot(force);
  const double most = friction * std::max(pressing, 0.0);
  return pressing * normal + at_most(force - pressing * normal, most);
}

/// Adds the touches of vertices that are not among them yet; both in the order of the vertices.
void join_touches(std::span<const Touch> more, std::vector<Touch>& touches) {
  const auto is_before = [](const Touch& a, const Touch& b) { return a.vertex < b.vertex; };
  for (const Touch& touch : more) {
    const auto at = std::lower_bound(touches.begin(), touches.end(), touch, is_before);
    if (at == touches.end() || is_before(touch, *at)) touches.insert(at, touch);
  }
}

}  // namespace

ContactMemory::ContactMemory(ClothModel& model, ContactForces wanted) : model_(model) {
  if (!model.contact) return;
  const auto n_vertices = static_cast<std::size_t>(model.n_vertices());
  is_exempt_.resize(n_vertices);
  if (wanted == ContactForces::forgotten ||
      model.contact->options().response != ContactResponse::resting)
    return;
  forces_ = Positions::Zero(3, model.n_vertices());
  for (std::vector<Touch>* touches : {&touches_, &foreseen_, &settled_})
    touches->reserve(n_vertices);
  plans_.reserve(n_vertices);
  positions_begin_.resize(3, model.n_vertices());
  velocities_begin_.resize(3, model.n_vertices());
  stopped_ = Eigen::VectorXd::Zero(model.n_vertices());
}

std::span<const char> ContactMemory::exempt() {
  std::fill(is_exempt_.begin(), is_exempt_.end(), char{0});
  for (const HangingVertex& h : model_.hanging) is_exempt_[h.vertex] = 1;
  for (const Pin& pin : model_.pins) is_exempt_[pin.vertex] = 1;
  return is_exempt_;
}

double ContactMemory::friction_of(const Touch& touch) const {
  return model_.contact->colliders()[static_cast<std::size_t>(touch.solid)].friction;
}

// Contact leaves a vertex that it touches no velocity off the solid. Where there is more than the
// remembered force takes, either has been given another one, and a hold would pull the vertex back.
bool ContactMemory::has_left(const Touch& touch, const State& begin, double h) const {
  const VertexId v = touch.vertex;
  if (is_exempt_[v] != 0) return true;
  if (touch.in_corner) return false;
  const Vec3 slide =
      begin.velocities.col(v) - model_.contact->solid_velocity(touch, begin.positions.col(v));
  const double leaving = model_.masses[v] / h * touch.normal.dot(slide);
  return leaving > std::max(touch.normal.dot(forces_.col(v)), 0.0);
}

// The way that counts is that of a vertex which nothing holds up: it is known by its remembered
// force where cloth was carried over, and its touches were not.
void ContactMemory::foresee(const State& begin, double h) {
  foreseen_.clear();
  auto next_touched = touches_.begin();
  for (Eigen::Index i = 0; i < begin.positions.cols(); ++i) {
    if (next_touched != touches_.end() && next_touched->vertex == i) {
      ++next_touched;
      continue;
    }
    if (is_exempt_[static_cast<std::size_t>(i)] != 0) continue;
    const Vec3 end = begin.positions.col(i) + h * begin.velocities.col(i) -
                     h * h / model_.masses[i] * forces_.col(i);
    const auto met = model_.contact->first_met(VertexId(i), begin.positions.col(i), end);
    if (met) foreseen_.push_back(*met);
  }
  join_touches(foreseen_, touches_);
}

// With w the slide across the solid's normal n and u the solid's velocity, the vertex comes to p =
// x + h (u + w) along the tangent. There the gap is g and the normal n', and u + (n'.w - g/h) n'
// leads onto the surface. Friction is at most the impulse b = mu h p, with p = n'.f less what turns
// the way round the solid, see settle(). At the slip s, which changes as in the last substep or not
// at all, whichever is faster, a hold of the share b/(r s) across n' takes that much; with all of r
// the vertex sticks. While it slips its friction is of this hold alone, and none is remembered. It
// is that of the last substep's force: should the vertex leave, it still has to be rubbed by it,
// and by what settling took of its fall, which is what turned it round the solid too.
ContactMemory::Plan ContactMemory::planned(const Touch& touch, const State& begin, double h,
                                           double resistance, Pressing of) {
  const VertexId v = touch.vertex;
  const Vec3 solid_velocity = model_.contact->solid_velocity(touch, begin.positions.col(v));
  const Vec3 along = across(begin.velocities.col(v) - solid_velocity, touch.normal);
  const Gap gap =
      model_.contact->gap_at_end(touch, begin.positions.col(v) + h * (solid_velocity + along));
  Plan plan;
  plan.touch = touch;
  plan.normal = gap.normal;
  plan.velocity = solid_velocity + (gap.normal.dot(along) - gap.distance / h) * gap.normal;
  if (touch.in_corner) {
    plan.grip = touch.sticks ? 1 : 0;
    return plan;
  }
  const Vec3 force = turned(forces_.col(v), touch.normal, gap.normal);
  const double pressing = std::max(gap.normal.dot(force), 0.0);
  const double turn = std::max(gap.normal.dot(plan.velocity - solid_velocity), 0.0);
  const double rubbing = std::max(pressing - model_.masses[v] / h * turn, 0.0);
  const Vec3 fall = begin.velocities.col(v) + h * model_.gravity;
  const double stop = model_.masses[v] * (gap.normal.dot(plan.velocity - fall) - turn);
  const bool goes_by_mass = of == Pressing::of_own_mass && rubbing > 0;
  const double brake = friction_of(touch) * (goes_by_mass ? std::max(stop, 0.0) : h * rubbing);
  plan.owed = friction_of(touch) * std::max(pressing + stopped_[v] / h, 0.0);
  const Vec3 last_change = begin.velocities.col(v) - velocities_begin_.col(v);
  const double slip = std::max(across(along + last_change, gap.normal).norm(), along.norm());
  const double whole = resistance * slip;
  const bool sticks = brake > 0 && brake >= whole;
  if (brake > 0) plan.grip = sticks ? 1 : brake / whole;
  forces_.col(v) = sticks ? force : Vec3(pressing * gap.normal);
  return plan;
}

ContactMemory::Plan& ContactMemory::plan_of(VertexId vertex) {
  const auto is_before = [](const Plan& plan, VertexId v) { return plan.touch.vertex < v; };
  return *std::lower_bound(plans_.begin(), plans_.end(), vertex, is_before);
}

void ContactMemory::turn_forces(const State& begin, double h) {
  if (!has_forces()) return;
  for (const Touch& touch : touches_) {
    if (touch.in_corner) continue;
    const VertexId v = touch.vertex;
    const Vec3 solid_velocity = model_.contact->solid_velocity(touch, begin.positions.col(v));
    const Vec3 along = across(begin.velocities.col(v) - solid_velocity, touch.normal);
    const Gap gap =
        model_.contact->gap_at_end(touch, begin.positions.col(v) + h * (solid_velocity + along));
    forces_.col(v) = turned(forces_.col(v), touch.normal, gap.normal);
  }
}

void ContactMemory::plan(const State& begin, double h, const Eigen::VectorXd& resistances,
                         double share, Pressing pressing) {
  plans_.clear();
  if (!has_forces()) return;
  is_planned_ = true;
  if (!has_planned_) velocities_begin_ = begin.velocities;
  has_planned_ = true;
  exempt();
  const auto has_left_here = [&](const Touch& touch) { return has_left(touch, begin, h); };
  touches_.erase(std::remove_if(touches_.begin(), touches_.end(), has_left_here), touches_.end());
  foresee(begin, h);
  forget_untouched();
  for (const Touch& touch : touches_) {
    plans_.push_back(planned(touch, begin, h, share * resistances[touch.vertex], pressing));
    plans_.back().resistance = resistances[touch.vertex];
  }
  positions_begin_ = begin.positions;
  velocities_begin_ = begin.velocities;
}

// Takes what a force did to a vertex that resists alone out of its state, so that contact acts on
// what the vertex would do without it.
void ContactMemory::let_go(VertexId vertex, State& state, double h, double resistance,
                           double travel_share) const {
  const Vec3 change = h / resistance * forces_.col(vertex);
  state.velocities.col(vertex) -= change;
  state.positions.col(vertex) -= travel_share * h * change;
}

// A vertex that is pressed ends on the surface, which curves away from the tangent that the solve
// held it to, and without velocity off it. This takes half of the way round from it, which the
// force does not know of: on a ball of radius R the force comes to m (g.n - w^2/2R). One that is
// not pressed by as much as that takes leaves, and is given back what pulled it, or rubbed it more
// than it was owed.
void ContactMemory::settle(const Plan& plan, State& state, double h, double resistance) {
  const VertexId v = plan.touch.vertex;
  auto force = forces_.col(v);
  auto velocity = state.velocities.col(v);
  const Vec3 solid_velocity = model_.contact->solid_velocity(plan.touch, positions_begin_.col(v));
  const double turn = std::max(plan.normal.dot(plan.velocity - solid_velocity), 0.0);
  const double pressing = plan.normal.dot(force);
  if (plan.leaves || pressing <= model_.masses[v] / h * turn) {
    const Vec3 pull = std::min(pressing, 0.0) * plan.normal;
    const Vec3 rubbing = force - pressing * plan.normal;
    const Vec3 excess = rubbing - at_most(rubbing, plan.owed);
    const Vec3 change = h * (pull / plan.resistance + excess / resistance);
    velocity -= change;
    state.positions.col(v) -= h * change;
    force.setZero();
    stopped_[v] = 0;
    return;
  }
  Touch touch = plan.touch;
  const Gap gap = model_.contact->gap_at_end(touch, state.positions.col(v));
  touch.sticks = plan.grip == 1;
  touch.normal = gap.normal;
  force = turned(in_cone(force, plan.normal, friction_of(touch)), plan.normal, gap.normal);
  state.positions.col(v) -= gap.distance * gap.normal;
  const double leaving = gap.normal.dot(velocity - solid_velocity);
  velocity -= leaving * gap.normal;
  stopped_[v] = -model_.masses[v] * leaving;
  settled_.push_back(touch);
}

// With f the remembered force and r the vertex's resistance, the place and velocity without f are
// x - h^2 f/r (times travel_share) and v - h f/r: what the vertex would do were it let go. Contact
// acts on those in corners, and without a plan, so it never pulls and stays inside Coulomb's cone.
// f then grows by the force m dv/h that makes of the solved velocity the corrected one, and
// vanishes where the vertex leaves. With r = m, that is of a free particle, it is the whole new
// force.
void ContactMemory::let_go(State& state, double h, const Eigen::VectorXd& resistances,
                           double travel_share) {
  settled_.clear();
  if (!has_forces()) return;
  solved_velocities_ = state.velocities;
  if (!is_planned_) {
    for (const Touch& touch : touches_) {
      auto place = state.positions.col(touch.vertex);
      const Gap gap = model_.contact->gap_at_end(touch, place);
      if (gap.distance > 0 && gap.normal.dot(forces_.col(touch.vertex)) > 0)
        place -= gap.distance * gap.normal;
    }
    for (Eigen::Index i = 0; i < state.positions.cols(); ++i)
      if (!model_.hangs(VertexId(i))) let_go(VertexId(i), state, h, resistances[i], travel_share);
    return;
  }
  is_planned_ = false;
  for (const Plan& plan : plans_) {
    const VertexId v = plan.touch.vertex;
    if (plan.touch.in_corner) {
      let_go(v, state, h, resistances[v], travel_share);
      stopped_[v] = 0;
    } else {
      settle(plan, state, h, resistances[v]);
      solved_velocities_.col(v) = state.velocities.col(v);
    }
  }
}

void ContactMemory::forget_untouched() {
  Eigen::Index first_untouched = 0;
  const auto forget_until = [&](Eigen::Index end) {
    forces_.middleCols(first_untouched, end - first_untouched).setZero();
    stopped_.segment(first_untouched, end - first_untouched).setZero();
  };
  for (const Touch& touch : touches_) {
    forget_until(touch.vertex);
    first_untouched = touch.vertex + 1;
  }
  forget_until(forces_.cols());
}

// All forces on a vertex in a corner are remembered as they are: they are not told apart. Of a
// vertex that came down in this substep the sweep has taken the friction of that already, and no
// force has to stop it again.
void ContactMemory::add_forces(std::span<const Touch> touches, const Positions& velocities,
                               double h) {
  for (const Touch& touch : touches) {
    const VertexId v = touch.vertex;
    auto force = forces_.col(v);
    const bool is_new = force.isZero(0) && has_planned_;
    force += model_.masses[v] / h * (velocities.col(v) - solved_velocities_.col(v));
    if (is_new && !touch.in_corner) {
      const Vec3 solid_velocity = model_.contact->solid_velocity(touch, positions_begin_.col(v));
      const double down = touch.normal.dot(solid_velocity - velocities_begin_.col(v));
      const double stop = std::min(model_.masses[v] / h * down, touch.normal.dot(force));
      force -= std::max(stop, 0.0) * touch.normal;
    }
    if (!touch.in_corner) force = in_cone(force, touch.normal, friction_of(touch));
  }
}

void ContactMemory::remember(std::span<const Touch> touches, const State& state, double h) {
  is_touched_ = is_touched_ || !touches.empty();
  if (!has_forces()) return;
  touches_.assign(touches.begin(), touches.end());
  forget_untouched();
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
  stopped_.setZero();
}

}  // namespace pleat
