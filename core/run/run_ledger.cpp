#include "core/run/run_ledger.h"

#include "core/scene/tearing.h"

namespace pleat {

RunLedger::RunLedger(const Simulation& simulation)
    : simulation_(simulation),
      account_(simulation.model(), simulation.state()),
      begin_(simulation.state()),
      time_begin_(simulation.time()) {}

void RunLedger::record_step() {
  if (simulation_.time() == time_begin_) return;
  const auto n_before = static_cast<std::size_t>(begin_.positions.cols());
  const auto n_now = static_cast<std::size_t>(simulation_.state().positions.cols());
  if (n_now > n_before) {
    const auto origins = simulation_.tear_origins().last(n_now - n_before);
    const Tearing& tearing = *simulation_.scene().model.tearing;
    begin_.positions = tearing.split(begin_.positions, origins);
    begin_.velocities = tearing.split(begin_.velocities, origins);
    account_.record_tear(begin_);
  }
  const ClothContact* contact = simulation_.stepper().cloth_contact();
  account_.record(begin_, simulation_.state(), simulation_.time(), simulation_.scene().method.step,
                  contact != nullptr ? contact->pressed() : std::span<const char>());
  begin_ = simulation_.state();
  time_begin_ = simulation_.time();
}

}  // namespace pleat
