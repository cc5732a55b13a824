#include "core/dynamics/stepper.h"

#include "core/base/check.h"
#include "core/base/formatted.h"
#include "core/linalg/make_linear_solver.h"
#include "core/model/elasticity.h"
#include "core/model/hanging_vertices.h"

namespace pleat {
namespace {

/// The first vertex that has left all bounds, or is not finite; invalid when none has.
VertexId first_lost(const State& state) {
  constexpr double kFarthest = kLargestCoordinate * kLargestCoordinate;
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i)
    if (!(squared_norm(state.positions, i) <= kFarthest) ||
        !(squared_norm(state.velocities, i) <= kFarthest))
      return VertexId(i);
  return VertexId();
}

SolveReport lost_report(VertexId vertex, double time) {
  SolveReport report;
  report.status = SolveStatus::not_finite;
  report.message =
      formatted("vertex %d diverged in the step from %.6g s: beyond %.0g m or m/s, or not finite",
                vertex.value, time, kLargestCoordinate);
  return report;
}

}  // namespace

Stepper::Stepper(ClothModel& model, const MethodOptions& options, int substeps,
                 ContactForces contact_forces)
    : model_(model),
      contact_memory_(model, contact_forces),
      options_(options),
      substeps_(substeps),
      first_contact_(model, options.first_contact) {
  options.validate();
  model.validate();
  if (model.strain_limit) strain_limit_.emplace(model);
  if (model.self_contact) cloth_contact_.emplace(model);
}

void Stepper::start_from_contact_forces(const PositionsView& forces) {
  if (!contact_memory_.has_forces()) return;
  PLEAT_CHECK(forces.cols() == model_.n_vertices(), "a contact force for every vertex");
  contact_memory_.forces() = forces;
}

void Stepper::load(const State&) {}

void Stepper::store(State&, SolveReport&) {}

// NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref is handed on to be written through.
void Stepper::read_places(const State& state, PositionsRef places) const {
  places = state.positions;
}

void Stepper::change(State& state, VertexId vertex, const Vec3& place, const Vec3& velocity) {
  state.positions.col(vertex) = place;
  state.velocities.col(vertex) += velocity;
}

SolveReport Stepper::advance(State& state, double time) {
  if (cloth_contact_) cloth_contact_->begin_step();
  PLEAT_CHECK(state.positions.cols() == model_.n_vertices() &&
                  state.velocities.cols() == model_.n_vertices(),
              "a state has the model's vertices");
  if (const VertexId bad = first_lost(state); bad.valid()) return lost_report(bad, time);
  place_between_parents(model_.hanging, state);
  last_finite_ = state;
  if (model_.bend_friction) model_.bend_friction->keep(last_friction_);
  const double h = options_.step / substeps_;
  const FirstContact::Substep run = [this](State& s, double end, double length) {
    return substep_in_world(s, end, length);
  };
  SolveReport report;
  load(state);
  for (int s = 1; s <= substeps_; ++s) {
    const double time_end = time + options_.step * s / substeps_;
    SolveReport part = first_contact_.is_awaited()
                           ? first_contact_.advance(run, state, contact_memory_, time_end, h)
                           : run(state, time_end, h);
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
  if (model_.contact) {
    const PartScope scope(observer_, Part::contact);
    model_.contact->begin_substep(time_end - h, time_end);
    contact_memory_.begin_substep();
  }
  if (model_.air) model_.air->set_time(time_end);
  if (cloth_contact_) {
    const PartScope scope(observer_, Part::cloth_contact);
    read_places(state, cloth_contact_->begins());
    cloth_contact_->place_bodies(time_end - h, time_end);
  }
  SolveReport report = substep(state, time_end, h);
  place_between_parents(model_.hanging, state);
  if (cloth_contact_ && !report.ends_run()) keep_cloth_apart(state, time_end, h);
  if (model_.bend_friction) model_.bend_friction->end_substep(state.positions);
  return report;
}

void Stepper::keep_cloth_apart(State& state, double time_end, double h) {
  const PartScope scope(observer_, Part::cloth_contact);
  read_places(state, cloth_contact_->ends());
  for (const auto& [vertex, velocity] : cloth_contact_->hold(time_end - h, time_end))
    if (!model_.hangs(vertex)) change(state, vertex, cloth_contact_->ends().col(vertex), velocity);
  place_between_parents(model_.hanging, state);
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

// NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref is handed on to be written through.
void Stepper::set_external_forces(const State& state, PositionsRef forces) {
  const PartScope scope(observer_, Part::forces);
  forces.setZero();
  add_gravity(model_, forces);
  if (model_.air) model_.air->add_forces(state.positions, state.velocities, model_.hanging, forces);
}

std::span<const ContactPass::Touch> Stepper::touch_solids(
    State& state, std::span<const ContactPass::Touch> settled) {
  return model_.contact->resolve(positions_begin_, contact_memory_.exempt(), state.positions,
                                 state.velocities, settled);
}

void Stepper::resolve_contacts(State& state, double h, const Eigen::VectorXd& resistances,
                               double travel_share) {
  const PartScope scope(observer_, Part::contact);
  contact_memory_.let_go(state, h, resistances, travel_share);
  contact_memory_.remember(touch_solids(state, contact_memory_.settled()), state, h);
}

// Solids push cloth beyond its limits, and limits pull it into solids: each in turn, contact last.
void Stepper::limit_among_contacts(State& state, double h, double travel_share) {
  constexpr int kMaxRounds = 3;
  for (int round = 0; round < kMaxRounds && strain_limit_->is_exceeded(state.positions); ++round) {
    {
      const PartScope scope(observer_, Part::strain_limit);
      strain_limit_->limit_again(state, travel_share * h, model_.contact->touches());
    }
    const PartScope scope(observer_, Part::contact);
    contact_memory_.keep(state);
    contact_memory_.add(touch_solids(state, {}), state, h);
  }
}

void Stepper::correct(State& state, double time_end, double h, const Eigen::VectorXd& resistances,
                      double travel_share) {
  if (strain_limit_) {
    const PartScope scope(observer_, Part::strain_limit);
    strain_limit_->limit(state, travel_share * h);
  }
  if (model_.contact) resolve_contacts(state, h, resistances, travel_share);
  if (model_.contact && strain_limit_) limit_among_contacts(state, h, travel_share);
  if (!model_.contact && !strain_limit_) return;
  for (const Pin& pin : model_.pins) {
    state.positions.col(pin.vertex) = pin.position(time_end);
    state.velocities.col(pin.vertex) =
        (state.positions.col(pin.vertex) - positions_begin_.col(pin.vertex)) / h;
  }
}

}  // namespace pleat
