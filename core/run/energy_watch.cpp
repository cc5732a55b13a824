#include "core/run/energy_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pleat {
namespace {

/// Cloth is told that stores more than so many times what it can have. What conserves energy comes
/// to 1; contact lifts vertices onto solids, and a step takes weight at one end of its way.
constexpr double kRoom = 2;

bool stands(const Motion& motion) { return motion.kind == Motion::Kind::hold; }

/// True when solids hold no vertex higher than it is, but for what a start on them needs [m].
bool is_outside_of_solids(const Simulation& simulation) {
  constexpr double kDeepest = 1e-3;
  const auto& contact = simulation.model().contact;
  if (!contact) return true;
  const auto supports = contact->supports(simulation.state().positions, simulation.time());
  return std::all_of(supports.begin(), supports.end(),
                     [](const auto& support) { return support.height > -kDeepest; });
}

bool is_left_alone(const Simulation& simulation) {
  const ClothModel& model = simulation.model();
  const auto& solids = simulation.scene().colliders;
  const auto& bodies = simulation.scene().surface_solids;
  return !(model.air && model.air->has_wind()) &&
         std::all_of(model.pins.begin(), model.pins.end(),
                     [](const Pin& pin) { return stands(pin.motion); }) &&
         std::all_of(solids.begin(), solids.end(),
                     [](const Collider& solid) { return stands(solid.motion); }) &&
         std::all_of(bodies.begin(), bodies.end(),
                     [](const SurfaceSolid& body) { return stands(body.motion); }) &&
         is_outside_of_solids(simulation);
}

}  // namespace

EnergyWatch::EnergyWatch(const Simulation& simulation)
    : first_(total_energy(simulation.model(), simulation.state())),
      is_left_alone_(is_left_alone(simulation)) {}

EnergyWatch::Look EnergyWatch::look(const Simulation& simulation) const {
  const EnergyParts now = energy_parts(simulation.model(), simulation.state());
  return {now.elastic, std::max(0.0, first_ - now.gravity)};
}

// The energy of threads goes with the square of their strain: all strains times s store s^2 of it.
double EnergyWatch::explained_share(const Simulation& simulation) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!is_bounded(simulation)) return kInfinity;
  const Look found = look(simulation);
  return found.stored > 0 ? std::sqrt(kRoom * found.available / found.stored) : kInfinity;
}

}  // namespace pleat
