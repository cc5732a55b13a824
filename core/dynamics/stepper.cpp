#include "core/dynamics/stepper.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

#include "core/base/check.h"
#include "core/linalg/make_linear_solver.h"
#include "core/model/elasticity.h"
#include "core/model/hanging_vertices.h"
#include "core/model/system_matrix.h"

namespace pleat {
namespace {

/// The part of a vector across a unit normal.
Vec3 across(const Vec3& vector, const Vec3& normal) { return vector - normal.dot(vector) * normal; }

/// Of the step with which friction is found. With all of it, friction of what hardly slides points
/// wherever rounding does, and a symmetric drape does not stay so.
constexpr double kFrictionShare = 0.15;

/// Of a substep: contact that is sooner than this after its begin has been there before.
constexpr double kLeastShare = 1e-12;

/// The first vertex that has left all bounds, or is not finite; invalid when none has.
VertexId first_lost(const State& state) {
  constexpr double kFarthest = kLargestCoordinate * kLargestCoordinate;
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i)
    if (!(state.positions.col(i).squaredNorm() <= kFarthest) ||
        !(state.velocities.col(i).squaredNorm() <= kFarthest))
      return VertexId(i);
  return VertexId();
}

SolveReport lost_report(VertexId vertex, double time) {
  char sentence[120];
  std::snprintf(sentence, sizeof sentence,
                "vertex %d diverged in the step from %.6g s: beyond %.0g m or m/s, or not finite",
                vertex.value, time, kLargestCoordinate);
  SolveReport report;
  report.status = SolveStatus::not_finite;
  report.message = sentence;
  return report;
}

/// Adds the touches of vertices that are not among them yet; both in the order of the vertices.
void join_touches(std::span<const ContactStage::Touch> more,
                  std::vector<ContactStage::Touch>& touches) {
  const auto is_before = [](const ContactStage::Touch& a, const ContactStage::Touch& b) {
    return a.vertex < b.vertex;
  };
  const auto n_known = static_cast<std::ptrdiff_t>(touches.size());
  for (const ContactStage::Touch& touch : more)
    if (!std::binary_search(touches.begin(), touches.begin() + n_known, touch, is_before))
      touches.push_back(touch);
  std::inplace_merge(touches.begin(), touches.begin() + n_known, touches.end(), is_before);
}

}  // namespace

Stepper::Stepper(ClothModel& model, const MethodOptions& options, int substeps,
                 ContactMemory memory)
    : model_(model),
      options_(options),
      substeps_(substeps),
      memory_(model.contact && model.contact->options().response == ContactResponse::resting
                  ? memory
                  : ContactMemory::none) {
  options.validate();
  model.validate();
  if (model.strain_limit) strain_limit_.emplace(model);
  if (model.air && model.air->has_wind()) air_forces_ = Positions::Zero(3, model.n_vertices());
  if (!model.contact) return;
  const auto n_vertices = static_cast<std::size_t>(model.n_vertices());
  is_exempt_.resize(n_vertices);
  if (memory_ == ContactMemory::none) return;
  contact_forces_ = Positions::Zero(3, model.n_vertices());
  touches_.reserve(n_vertices);
}

void Stepper::start_from_contact_forces(const Eigen::Ref<const Positions>& forces) {
  if (memory_ == ContactMemory::none) return;
  PLEAT_CHECK(forces.cols() == model_.n_vertices(), "a contact force for every vertex");
  contact_forces_ = forces;
}

void Stepper::load(const State&) {}

void Stepper::store(State&, SolveReport&) {}

SolveReport Stepper::advance(State& state, double time) {
  PLEAT_CHECK(state.positions.cols() == model_.n_vertices() &&
                  state.velocities.cols() == model_.n_vertices(),
              "a state has the model's vertices");
  if (const VertexId bad = first_lost(state); bad.valid()) return lost_report(bad, time);
  place_between_parents(model_.hanging, state);
  last_finite_ = state;
  if (model_.bend_friction) model_.bend_friction->keep(last_friction_);
  const double h = options_.step / substeps_;
  SolveReport report;
  load(state);
  for (int s = 1; s <= substeps_; ++s) {
    const double time_end = time + options_.step * s / substeps_;
    SolveReport part = awaits_contact() ? substep_to_contact(state, time_end, h)
                                        : substep_in_world(state, time_end, h);
    const double last_residual = part.relative_residual;
    report.add(std::move(part));
    report.relative_residual = last_residual;
    if (report.ends_run()) break;
  }
  store(state, report);
  const VertexId bad = first_lost(state);
  if (bad.valid()) report = lost_report(bad, time);
  if (!report.ends_run()) return report;
  state = last_finite_;
  if (model_.bend_friction) model_.bend_friction->restore(last_friction_, state.positions);
  return report;
}

SolveReport Stepper::substep_in_world(State& state, double time_end, double h) {
  place_solids(time_end - h, time_end);
  if (model_.air) model_.air->set_time(time_end);
  is_touched_ = false;
  SolveReport report = substep(state, time_end, h);
  place_between_parents(model_.hanging, state);
  if (model_.bend_friction) model_.bend_friction->end_substep(state.positions);
  return report;
}

bool Stepper::awaits_contact() const {
  return options_.first_contact > 0 && model_.contact && !first_contact_;
}

void Stepper::begin_again(State& state) {
  state = before_contact_;
  if (model_.bend_friction)
    model_.bend_friction->restore(friction_before_contact_, state.positions);
  touches_.clear();
  contact_forces_ = forces_before_contact_;
}

// Shorter substeps are tried from the same state until one ends untouched and near enough; what is
// left of the whole begins at the contact. Cloth that touches from the beginning is not parted.
// What ends a fall is an impulse: as a force over the whole substeps that follow it is less than it
// was over the rest of this one.
SolveReport Stepper::substep_to_contact(State& state, double time_end, double h) {
  const double time_begin = time_end - h;
  before_contact_ = state;
  if (model_.bend_friction) model_.bend_friction->keep(friction_before_contact_);
  forces_before_contact_ = contact_forces_;
  SolveReport report = substep_in_world(state, time_end, h);
  if (!is_touched_ || report.ends_run()) return report;
  double free = 0;
  double touched = h;
  bool is_near = false;
  while (!is_near && touched - free > kLeastShare * h) {
    const double part = free + (touched - free) / 2;
    begin_again(state);
    report = substep_in_world(state, time_begin + part, part);
    if (report.ends_run()) return report;
    (is_touched_ ? touched : free) = part;
    is_near = !is_touched_ &&
              model_.contact->least_gap(state.positions, is_exempt_) <= options_.first_contact;
  }
  first_contact_ = time_begin + free;
  if (is_near) {
    report.add(substep_in_world(state, time_end, h - free));
    contact_forces_ *= (h - free) / h;
    return report;
  }
  begin_again(state);
  return substep_in_world(state, time_end, h);
}

void Stepper::place_solids(double time_begin, double time_end) {
  if (!model_.contact) return;
  const StageScope scope(observer_, Stage::contact);
  model_.contact->begin_substep(time_begin, time_end);
}

std::unique_ptr<LinearSolver> Stepper::make_solver(const MethodOptions& options,
                                                   int max_iterations) {
  if (!is_available(options.solver))
    throw InputError("/method/solver",
                     std::string("expected a solver of this build, got ") + name(options.solver) +
                         ", whose source could not be had when it was built; take eigen");
  return make_linear_solver(
      options.solver, {options.tolerance, max_iterations, options.omega, options.preconditioner});
}

void Stepper::set_steady_forces(Eigen::Ref<Positions> forces) {
  forces.setZero();
  add_gravity(model_, forces);
  if (memory_ != ContactMemory::none) forces += contact_forces_;
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref is handed on to be written through.
void Stepper::set_external_forces(const State& state, Eigen::Ref<Positions> forces) {
  const StageScope scope(observer_, Stage::forces);
  set_steady_forces(forces);
  if (model_.air) model_.air->add_forces(state.positions, state.velocities, model_.hanging, forces);
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref is handed on to be written through.
void Stepper::set_damped_external_forces(const State& state, double h,
                                         Eigen::Ref<Positions> forces) {
  const StageScope scope(observer_, Stage::forces);
  set_steady_forces(forces);
  if (model_.air) add_damped_air(state, h, forces);
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref is handed on to be written through.
void Stepper::add_damped_air(const State& state, double h, Eigen::Ref<Positions> forces) {
  model_.air->add_damped_forces(state.positions, state.velocities, model_.masses, model_.hanging, h,
                                air_forces_, forces);
}

void Stepper::add_air_resistance(double h, SystemMatrix& matrix) const {
  if (!model_.air) return;
  for (int i = 0; i < model_.n_vertices(); ++i)
    matrix.add_diagonal(VertexId(i), h * model_.air->resistance(VertexId(i)));
}

std::span<const ContactStage::Touch> Stepper::correct_for_contact(const Positions& positions_begin,
                                                                  State& state) {
  std::fill(is_exempt_.begin(), is_exempt_.end(), char{0});
  for (const HangingVertex& h : model_.hanging) is_exempt_[h.vertex] = 1;
  for (const Pin& pin : model_.pins) is_exempt_[pin.vertex] = 1;
  const auto touches =
      model_.contact->resolve(positions_begin, is_exempt_, state.positions, state.velocities);
  is_touched_ = is_touched_ || !touches.empty();
  return touches;
}

// A vertex that its force still presses has not left, though it may end above a round solid: it is
// brought down. With f the remembered force and r the vertex's resistance, the place and velocity
// without f are x - h^2 f/r (times travel_share) and v - h f/r: what the vertex would do were it
// let go. The contact acts on those, so it never pulls and stays inside Coulomb's cone. f then
// grows by the force m dv/h that makes of the solved velocity the corrected one, and vanishes where
// the vertex leaves. With r = m, that is of a free particle, it is the whole new force.
void Stepper::let_go(State& state, double h, const Eigen::VectorXd& resistances,
                     double travel_share) {
  solved_velocities_ = state.velocities;
  for (const ContactStage::Touch& touch : touches_) {
    auto place = state.positions.col(touch.vertex);
    const Gap gap = model_.contact->gap_at_end(touch, place);
    if (gap.distance > 0 && gap.normal.dot(contact_forces_.col(touch.vertex)) > 0)
      place -= gap.distance * gap.normal;
  }
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
    if (model_.hangs(VertexId(i))) continue;
    const Vec3 change = h / resistances[i] * contact_forces_.col(i);
    state.velocities.col(i) -= change;
    state.positions.col(i) -= travel_share * h * change;
  }
}

void Stepper::forget_untouched(std::span<const ContactStage::Touch> touches) {
  Eigen::Index first_untouched = 0;
  const auto forget_until = [&](Eigen::Index end) {
    contact_forces_.middleCols(first_untouched, end - first_untouched).setZero();
  };
  for (const ContactStage::Touch& touch : touches) {
    forget_until(touch.vertex);
    first_untouched = touch.vertex + 1;
  }
  forget_until(contact_forces_.cols());
}

// The solve holds a vertex that slips along the normal alone, so that it hears of friction only as
// a remembered force. That takes an augmented Lagrangian's step, with the resistance r, and is then
// held to Coulomb's cone. Once it would drive the vertex, the vertex sticks.
void Stepper::remember_friction(const Positions& positions_begin, const State& state, double h,
                                const Eigen::VectorXd& resistances) {
  for (ContactStage::Touch& touch : touches_) {
    if (touch.sticks || touch.in_corner) continue;
    const VertexId v = touch.vertex;
    const Vec3 friction_before = across(contact_forces_.col(v), touch.normal);
    const Vec3 slide =
        solved_velocities_.col(v) - model_.contact->solid_velocity(touch, positions_begin.col(v));
    touch.sticks = friction_before.dot(slide) > 0;
    if (touch.sticks) continue;
    contact_forces_.col(v) +=
        std::max(kFrictionShare * resistances[v] - model_.masses[v], 0.0) / h *
        across(state.velocities.col(v) - solved_velocities_.col(v), touch.normal);
  }
}

// Of a vertex in a corner all forces are remembered as they are: they are not told apart.
void Stepper::remember(std::span<const ContactStage::Touch> touches, const Positions& velocities,
                       double h) {
  for (const ContactStage::Touch& touch : touches) {
    const VertexId v = touch.vertex;
    auto force = contact_forces_.col(v);
    force += model_.masses[v] / h * (velocities.col(v) - solved_velocities_.col(v));
    if (touch.in_corner) continue;
    const double pressing = touch.normal.dot(force);
    const Vec3 rubbing = force - pressing * touch.normal;
    const double friction =
        model_.contact->colliders()[static_cast<std::size_t>(touch.solid)].friction;
    const double most = friction * std::max(pressing, 0.0);
    const double size = rubbing.norm();
    if (size > most) force = pressing * touch.normal + most / size * rubbing;
  }
}

void Stepper::resolve_contacts(const Positions& positions_begin, State& state, double h,
                               const Eigen::VectorXd& resistances, double travel_share) {
  const StageScope scope(observer_, Stage::contact);
  const bool remembers = memory_ != ContactMemory::none;
  if (remembers) let_go(state, h, resistances, travel_share);
  const auto touches = correct_for_contact(positions_begin, state);
  if (!remembers) return;
  touches_.assign(touches.begin(), touches.end());
  forget_untouched(touches);
  remember_friction(positions_begin, state, h, resistances);
  remember(touches_, state.velocities, h);
}

// Solids push cloth beyond its limits, and limits pull it into solids: each in turn, contact last.
void Stepper::limit_among_contacts(const Positions& positions_begin, State& state, double h,
                                   double travel_share) {
  constexpr int kMaxRounds = 3;
  for (int round = 0; round < kMaxRounds && strain_limit_->is_exceeded(state.positions); ++round) {
    {
      const StageScope scope(observer_, Stage::strain_limit);
      strain_limit_->limit_again(state, travel_share * h, model_.contact->touches());
    }
    const StageScope scope(observer_, Stage::contact);
    const bool remembers = memory_ != ContactMemory::none;
    if (remembers) solved_velocities_ = state.velocities;
    const auto touches = correct_for_contact(positions_begin, state);
    if (!remembers) continue;
    remember(touches, state.velocities, h);
    join_touches(touches, touches_);
  }
}

void Stepper::correct(const Positions& positions_begin, State& state, double time_end, double h,
                      const Eigen::VectorXd& resistances, double travel_share) {
  if (!has_corrections()) return;
  if (strain_limit_) {
    const StageScope scope(observer_, Stage::strain_limit);
    strain_limit_->limit(state, travel_share * h);
  }
  if (model_.contact) {
    resolve_contacts(positions_begin, state, h, resistances, travel_share);
    if (strain_limit_) limit_among_contacts(positions_begin, state, h, travel_share);
  }
  for (const Pin& pin : model_.pins) {
    state.positions.col(pin.vertex) = pin.position(time_end);
    state.velocities.col(pin.vertex) =
        (state.positions.col(pin.vertex) - positions_begin.col(pin.vertex)) / h;
  }
}

}  // namespace pleat
