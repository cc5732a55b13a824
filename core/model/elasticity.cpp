#include "core/model/elasticity.h"

#include <type_traits>

#include "core/model/elements.h"

namespace pleat {

double elastic_energy(const ClothModel& model, const PositionsView& positions) {
  double energy = 0;
  for_each_element_kind(model, [&](const auto& kind) { kind.add_energy(positions, energy); });
  return energy;
}

EnergyParts energy_parts(const ClothModel& model, const State& state) {
  EnergyParts parts;
  parts.elastic = elastic_energy(model, state.positions);
  for (int i = 0; i < model.n_vertices(); ++i) {
    parts.kinetic += 0.5 * model.masses[i] * state.velocities.col(i).squaredNorm();
    parts.gravity -= model.masses[i] * model.gravity.dot(state.positions.col(i));
  }
  return parts;
}

double total_energy(const ClothModel& model, const State& state) {
  return energy_parts(model, state).sum();
}

void add_elastic_forces(const ClothModel& model, const PositionsView& positions,
                        PositionsRef forces) {
  for_each_element_kind(model, [&](const auto& kind) { kind.add_forces(positions, forces); });
}

void add_damping_forces(const ClothModel& model, const PositionsView& positions,
                        const PositionsView& velocities, PositionsRef forces) {
  for_each_element_kind(
      model, [&](const auto& kind) { kind.add_damping_forces(positions, velocities, forces); });
}

void add_internal_forces(const ClothModel& model, const PositionsView& positions,
                         const PositionsView& velocities, PositionsRef forces) {
  for_each_element_kind(model, [&](const auto& kind) {
    if constexpr (std::decay_t<decltype(kind)>::kHasInternalForces) {
      kind.add_internal_forces(positions, velocities, forces);
    } else {
      kind.add_forces(positions, forces);
      kind.add_damping_forces(positions, velocities, forces);
    }
  });
}

void add_gravity(const ClothModel& model, PositionsRef forces) {
  forces.noalias() += model.gravity * model.masses.transpose();
}

}  // namespace pleat
