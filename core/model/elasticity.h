#pragma once

#include "core/model/cloth_model.h"
#include "core/model/state.h"

namespace pleat {

/// Energy stored in the cloth, stretched and bent [J].
double elastic_energy(const ClothModel& model, const PositionsView& positions);

/// Energy of moving cloth by its kinds [J].
struct EnergyParts {
  double kinetic = 0;
  double elastic = 0;  ///< stretched and bent
  double gravity = 0;  ///< height zero is the origin

  double sum() const { return kinetic + elastic + gravity; }
};

EnergyParts energy_parts(const ClothModel& model, const State& state);

/// The sum of the parts [J].
double total_energy(const ClothModel& model, const State& state);

/// Adds the forces of all elements [N].
void add_elastic_forces(const ClothModel& model, const PositionsView& positions,
                        PositionsRef forces);

/// Adds the forces of dampers and of the membrane's viscosity [N].
void add_damping_forces(const ClothModel& model, const PositionsView& positions,
                        const PositionsView& velocities, PositionsRef forces);

/// Adds both [N], with one look at springs.
void add_internal_forces(const ClothModel& model, const PositionsView& positions,
                         const PositionsView& velocities, PositionsRef forces);

/// Adds weight [N].
void add_gravity(const ClothModel& model, PositionsRef forces);

}  // namespace pleat
