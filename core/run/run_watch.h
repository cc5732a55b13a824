#pragma once

#include <optional>
#include <vector>

#include "core/run/energy_watch.h"
#include "core/run/pin_stretch.h"
#include "core/run/rest_watch.h"
#include "core/run/run_warning.h"
#include "core/run/simulation.h"

namespace pleat {

/// Looks at a running simulation and tells when it shows what the scene cannot explain. Costs
/// nothing between looks.
class RunWatch {
 public:
  /// simulation  at the start of its run
  explicit RunWatch(const Simulation& simulation);

  /// step  the report of the steps since the last look
  void check(const Simulation& simulation, const SolveReport& step);
  /// Call it after the last step: what has come to rest is looked at once more.
  void check_end(const Simulation& simulation);

  /// At most one of each kind, as they were seen, but that which is not nonsense last.
  const std::vector<RunWarning>& warnings() const { return warnings_; }
  /// Share of the weight of cloth at rest that is not balanced, at the last look; NaN before.
  double unbalanced_share() const;
  const RestWatch& rest() const { return rest_; }

 private:
  void check_stretch(const Simulation& simulation);
  double stretch_between_pins(const Simulation& simulation);
  double explained_softness(const Simulation& simulation);
  void check_speed(const Simulation& simulation);
  void check_cloth_contact(const Simulation& simulation);
  void check_report(const Simulation& simulation, const SolveReport& step);
  void tell_unbalanced(const Simulation& simulation, const std::optional<RestWatch::Look>& look);
  void warn(const Simulation& simulation, RunWarning warning);
  void warn(const Simulation& simulation, RunWarning warning, double excess);

  double stiffness_;         // force per strain of what holds the cloth [N]
  double load_stretch_;      // stretch under the cloth's whole weight, with room for motion [1]
  double room_for_swing_;    // weights that a swing pulls by at most
  bool has_known_load_;      // hangs from pins alone, in threads of known stiffness
  double soft_stretch_;      // stretch that the fabric explains, as far as it was asked for [1]
  double stored_stretch_;    // stretch beyond which stored energy is asked for [1]
  double start_stretch_;     // [1]
  double start_height_;      // height of the highest vertex against gravity [m]
  double start_slack_;       // way that cloth falls until its pins hold it [m]
  double start_speed_;       // speed at the start, with what the energy stored there can give [m/s]
  double driven_speed_ = 0;  // the largest so far of pins and solids [m/s]
  int n_unsolved_ = 0;       // looks in a row that saw a step left unsolved
  double unsolved_since_ = 0;  // the first of them [s]
  EnergyWatch energy_;
  PinStretch pin_stretch_;
  RestWatch rest_;
  std::vector<RunWarning> warnings_;
};

}  // namespace pleat
