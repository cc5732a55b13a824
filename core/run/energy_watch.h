#pragma once

#include <optional>

#include "core/model/elasticity.h"
#include "core/run/simulation.h"

namespace pleat {

/// Tells what cloth stores from what it can have. Where air, pins and solids stand still, nothing
/// works on it but its own weight: it stores no more than what it had at the start and fell
/// through. More is a step's own making, whatever the load (docs/methods/plausibility.md).
class EnergyWatch {
 public:
  /// simulation  at the start of its run
  explicit EnergyWatch(const Simulation& simulation);

  /// False where something else works on the cloth, now or by its scene, or has since the start.
  bool is_bounded(const Simulation& simulation) const {
    return is_left_alone_ && !simulation.is_disturbed();
  }

  struct Look {
    double stored;     ///< energy of stretch and bending [J]
    double available;  ///< most that it can be [J]
  };

  /// Both energies now; of use where the cloth is bounded. Costs about as much as the forces.
  Look look(const Simulation& simulation) const;

  /// Share of all strains with which the cloth would store what it can have, with some room: below
  /// 1 it stores more. Infinite where it stores nothing or is not bounded.
  double explained_share(const Simulation& simulation) const;

 private:
  double first_;  // energy at the start, heights from the origin [J]
  bool is_left_alone_;
};

}  // namespace pleat
