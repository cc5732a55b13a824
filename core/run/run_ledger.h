#pragma once

#include "core/model/energy_ledger.h"
#include "core/run/simulation.h"

namespace pleat {

/// Accounts for the energy of a running simulation, which may tear.
class RunLedger {
 public:
  /// simulation  outlives this; the account begins with its present state
  explicit RunLedger(const Simulation& simulation);

  /// Call after each step. One that ended the run leaves the account as it was.
  void record_step();

  const EnergyLedger& account() const { return account_; }

 private:
  const Simulation& simulation_;
  EnergyLedger account_;
  State begin_;
  double time_begin_;  // [s]
};

}  // namespace pleat
