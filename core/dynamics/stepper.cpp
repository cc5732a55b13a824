#include "core/dynamics/stepper.h"

#include "core/base/check.h"
#include "core/dynamics/stepper_explicit.h"
#include "core/dynamics/stepper_implicit.h"
#include "core/dynamics/stepper_projective.h"
#include "core/dynamics/stepper_xpbd.h"

namespace pleat {
namespace {

/// The first vertex whose position or velocity is not finite; invalid when all are.
VertexId first_not_finite(const State& state) {
  if (state.positions.allFinite() && state.velocities.allFinite()) return VertexId();
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i)
    if (!state.positions.col(i).allFinite() || !state.velocities.col(i).allFinite())
      return VertexId(i);
  return VertexId();
}

SolveReport not_finite_report(VertexId vertex, double time) {
  SolveReport report;
  report.status = SolveStatus::not_finite;
  report.message = "vertex " + std::to_string(vertex.value) +
                   " is no longer finite in the step from " + std::to_string(time) + " s";
  return report;
}

}  // namespace

const char* name(StepperKind kind) {
  switch (kind) {
    case StepperKind::explicit_euler:
      return "explicit";
    case StepperKind::implicit_euler:
      return "implicit";
    case StepperKind::projective:
      return "projective";
    case StepperKind::xpbd:
      return "xpbd";
  }
  return "";
}

void MethodOptions::validate() const {
  PLEAT_CHECK(step > 0, "a step is positive");
  PLEAT_CHECK(substeps >= (stepper == StepperKind::explicit_euler ? 0 : 1), "at least one substep");
  PLEAT_CHECK(iterations >= 1, "at least one iteration");
  PLEAT_CHECK(tolerance > 0 && tolerance < 1, "a relative residual lies between 0 and 1");
}

Stepper::Stepper(ClothModel& model, const MethodOptions& options, int substeps)
    : model_(model), options_(options), substeps_(substeps) {
  options.validate();
  model.validate();
  if (model.contact) contact_forces_ = Positions::Zero(3, model.n_vertices());
}

void Stepper::load(const State&) {}

void Stepper::store(State&, SolveReport&) {}

SolveReport Stepper::advance(State& state, double time) {
  PLEAT_CHECK(state.positions.cols() == model_.n_vertices() &&
                  state.velocities.cols() == model_.n_vertices(),
              "a state has the model's vertices");
  if (const VertexId bad = first_not_finite(state); bad.valid())
    return not_finite_report(bad, time);
  last_finite_ = state;
  const double h = options_.step / substeps_;
  SolveReport report;
  load(state);
  for (int s = 1; s <= substeps_; ++s) {
    SolveReport part = substep(state, time + options_.step * s / substeps_, h);
    part.iterations += report.iterations;
    if (!report.ok() &&
        part.ok()) {  // a cap met in an earlier substep is not hidden by a later one
      part.status = report.status;
      part.message = std::move(report.message);
    }
    report = std::move(part);
    if (report.status == SolveStatus::not_finite ||
        report.status == SolveStatus::not_positive_definite)
      break;
  }
  store(state, report);
  const VertexId bad = first_not_finite(state);
  if (bad.valid()) report = not_finite_report(bad, time);
  if (!report.ok() && report.status != SolveStatus::not_converged) state = last_finite_;
  return report;
}

void Stepper::add_contact_forces(Eigen::Ref<Positions> forces) const {
  if (model_.contact) forces += contact_forces_;
}

// With f the remembered force, the proposed place and velocity without it are x - h^2 f/m and v - h
// f/m: what the vertex would do were it let go. The contact acts on those, so that the new force, m
// dv/h, is the whole one: never pulling, and inside Coulomb's cone. It equals f where the vertex is
// held in equilibrium and vanishes where it leaves.
void Stepper::resolve_contacts(const Positions& positions_begin, State& state, double time_end,
                               double h) {
  if (!model_.contact) return;
  const StageScope scope(observer_, Stage::contact);
  model_.contact->begin_substep(time_end - h, time_end);
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
    const double mobility = h / model_.masses[i];
    const Vec3 free_velocity = state.velocities.col(i) - mobility * contact_forces_.col(i);
    Vec3 position = state.positions.col(i) - h * mobility * contact_forces_.col(i);
    Vec3 velocity = free_velocity;
    model_.contact->resolve(positions_begin.col(i), position, velocity);
    state.positions.col(i) = position;
    state.velocities.col(i) = velocity;
    contact_forces_.col(i) = (velocity - free_velocity) / mobility;
  }
  // A pin wins over a solid: it is where the scene puts it.
  for (const Pin& pin : model_.pins) {
    state.positions.col(pin.vertex) = pin.position(time_end);
    state.velocities.col(pin.vertex) =
        (state.positions.col(pin.vertex) - positions_begin.col(pin.vertex)) / h;
    contact_forces_.col(pin.vertex).setZero();
  }
}

std::unique_ptr<Stepper> make_stepper(ClothModel& model, const MethodOptions& options) {
  switch (options.stepper) {
    case StepperKind::explicit_euler:
      return std::make_unique<StepperExplicit>(model, options);
    case StepperKind::implicit_euler:
      return std::make_unique<StepperImplicit>(model, options);
    case StepperKind::projective:
      return std::make_unique<StepperProjective>(model, options);
    case StepperKind::xpbd:
      return std::make_unique<StepperXpbd>(model, options);
  }
  throw ContractError("unknown stepper");
}

}  // namespace pleat
