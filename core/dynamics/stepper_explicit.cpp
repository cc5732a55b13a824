#include "core/dynamics/stepper_explicit.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/base/check.h"
#include "core/dynamics/elasticity.h"

namespace pleat {
namespace {

constexpr double kStepShare = 0.9;  // of the bound, used when the substeps are ours to choose

[[noreturn]] void refuse(const char* format, double bound, double found, double enough) {
  char sentence[200];
  std::snprintf(sentence, sizeof sentence, format, bound, found, enough);
  throw InputError("/method/substeps", sentence);
}

/// Substeps of a step: as asked, or as many as the bound needs.
int explicit_substeps(const ClothModel& model, const MethodOptions& options) {
  const double bound = StepperExplicit::largest_stable_step(model);
  const double enough = std::max(1.0, std::ceil(options.step / (kStepShare * bound)));
  if (options.substeps > 0) {
    const double h = options.step / options.substeps;
    if (h <= bound) return options.substeps;
    refuse(
        "expected explicit substeps of at most %.3g s, the stability bound of this cloth, got %.3g "
        "s (%.7g substeps would do)",
        bound, h, enough);
  }
  if (enough <= kMaxSubsteps) return static_cast<int>(enough);
  refuse(
      "expected cloth that is stable in explicit substeps of %.3g s, got one that needs %.3g s "
      "(%.7g substeps)",
      options.step / kMaxSubsteps, bound, enough);
}

}  // namespace

StepperExplicit::StepperExplicit(ClothModel& model, const MethodOptions& options)
    : Stepper(model, options, explicit_substeps(model, options), ContactMemory::none),
      forces_(3, model.n_vertices()),
      positions_begin_(3, model.n_vertices()) {}

double StepperExplicit::largest_stable_step(const ClothModel& model) {
  Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(model.n_vertices());
  Eigen::VectorXd damping = Eigen::VectorXd::Zero(model.n_vertices());
  for (const Spring& spring : model.springs) {
    for (const VertexId v : {spring.a, spring.b}) {
      stiffness[v] += spring.stiffness;
      damping[v] += spring.damping;
    }
  }
  for (const BendElement& bend : model.bends) {
    const auto& w = bend.weights;
    const double sum = std::abs(w[0]) + std::abs(w[1]) + std::abs(w[2]);
    for (int k = 0; k < 3; ++k)
      stiffness[bend.vertices[k]] += bend.stiffness * std::abs(w[k]) * sum / 2;
  }
  // h^2 k + 2 h c = 2 m has the positive root h = 2 m / (c + sqrt(c^2 + 2 m k)).
  double bound = std::numeric_limits<double>::infinity();
  for (int i = 0; i < model.n_vertices(); ++i) {
    const double root =
        damping[i] + std::sqrt(damping[i] * damping[i] + 2 * model.masses[i] * stiffness[i]);
    if (root > 0) bound = std::min(bound, 2 * model.masses[i] / root);
  }
  return bound;
}

SolveReport StepperExplicit::substep(State& state, double time_end, double h) {
  positions_begin_ = state.positions;
  set_external_forces(state, 0, forces_);
  {
    const StageScope scope(observer_, Stage::forces);
    add_elastic_forces(model_, state.positions, forces_);
    add_damping_forces(model_, state.positions, state.velocities, forces_);
  }
  {
    const StageScope scope(observer_, Stage::solve);
    for (int i = 0; i < model_.n_vertices(); ++i)
      state.velocities.col(i) += h / model_.masses[i] * forces_.col(i);
    for (const Pin& pin : model_.pins)
      state.velocities.col(pin.vertex) =
          (pin.position(time_end) - state.positions.col(pin.vertex)) / h;
    state.positions += h * state.velocities;
    for (const Pin& pin : model_.pins) state.positions.col(pin.vertex) = pin.position(time_end);
  }
  resolve_contacts(positions_begin_, state, time_end, h);
  return {};
}

}  // namespace pleat
