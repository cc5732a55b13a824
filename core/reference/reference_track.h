#pragma once

#include <optional>
#include <vector>

#include "core/reference/reference.h"
#include "core/run/simulation.h"

namespace pleat {

/// A reference that a running simulation is compared with.
class ReferenceTrack {
 public:
  /// Throws InputError without samples.
  explicit ReferenceTrack(Reference reference);

  /// True for a scene of the same content, whatever its level and method, unless the reference was
  /// made by other physics.
  bool is_of(const Scene& scene) const {
    return !is_stale() && reference_.content == content_id(scene);
  }
  bool is_stale() const { return reference_.physics != kPhysicsVersion; }
  const ReferenceLabel& label() const { return reference_.label; }
  double end() const { return reference_.samples.back().time; }  ///< [s]

  struct Distance {
    double rms = 0;          ///< RMS over material points, by area [m]
    double uncertainty = 0;  ///< uncertainty of the reference then [m]; NaN: unknown
  };

  /// Measured from the simulation's present state to the reference at its time; nothing beyond its
  /// end and for a disturbed simulation (Simulation::is_disturbed).
  /// Between samples the reference goes straight. A sheet that is finer than it is compared with
  /// it along its mesh lines, another mesh at the vertices that both have.
  ///
  /// simulation  whose scene `is_of` accepts
  std::optional<Distance> distance(const Simulation& simulation);

  /// A distance per vertex, as `distance` found it [m]; 0 where the reference has none.
  const std::vector<float>& distances() const { return distances_; }

 private:
  std::size_t sample_after(double time) const;

  Reference reference_;
  std::vector<float> distances_;
};

}  // namespace pleat
