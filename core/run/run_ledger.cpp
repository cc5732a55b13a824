#include "core/run/run_ledger.h"

namespace pleat {

RunLedger::RunLedger(const Simulation& simulation)
    : simulation_(simulation),
      account_(simulation.model(), simulation.state()),
      begin_(simulation.state()),
      time_begin_(simulation.time()) {}

void RunLedger::look() {
  if (simulation_.time() == time_begin_) return;
  account_.record(begin_, simulation_.state(), simulation_.time(), simulation_.scene().method.step);
  begin_ = simulation_.state();
  time_begin_ = simulation_.time();
}

}  // namespace pleat
