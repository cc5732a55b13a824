#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "core/run/equilibrium_check.h"
#include "core/run/simulation.h"

namespace pleat {

/// Waits until a running simulation's cloth is at rest, and looks then whether its model is in
/// equilibrium: now and then, at no more than a hundredth of the work of the steps. Takes no memory
/// before its first look.
class RestWatch {
 public:
  struct Look {
    double time;   ///< [s]
    double share;  ///< share of the weight that is not balanced (EquilibriumCheck)
    double bound;  ///< share that is small, and that which trembling explains
  };

  /// simulation  at the start of its run
  explicit RestWatch(const Simulation& simulation);

  /// Call it after each step of that simulation. Returns what a look has found where one was due.
  std::optional<Look> after_step(const Simulation& simulation);
  /// Looks at what has come to rest, however little work its steps were.
  std::optional<Look> at_end(const Simulation& simulation);

  /// The last look; nothing before.
  const std::optional<Look>& last() const { return last_; }
  /// Work of looks per vertex so far, in units of StepperType::substep_cost.
  double work() const { return work_; }

 private:
  void follow(const Simulation& simulation);
  void begin_interval(const Simulation& simulation, const Vec3& drift);
  bool is_at_rest(const Simulation& simulation) const;
  std::optional<Look> look(const Simulation& simulation);

  std::optional<EquilibriumCheck> check_;
  std::int64_t topology_;  // topology that the check knows
  std::int64_t n_steps_;   // steps at the last call
  double work_of_steps_ = 0;
  double work_ = 0;
  double work_of_next_look_;
  std::optional<Look> last_;
  // Intervals of rest follow one another. In each, speeds are against the drift at its start.
  double rest_begin_;          // start of its rest [s]
  double interval_begin_;      // [s]
  Vec3 drift_{0, 0, 0};        // [m/s]
  double fastest_ = 0;         // RMS speed in the interval [m/s]
  double fastest_before_ = 0;  // RMS speed in the interval before [m/s]
};

}  // namespace pleat
