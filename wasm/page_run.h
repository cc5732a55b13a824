#pragma once

#include <emscripten/val.h>

#include <functional>
#include <memory>
#include <optional>

#include "core/run/run_watch.h"
#include "core/run/simulation.h"
#include "core/run/timed_run.h"

namespace pleat {

/// A simulation that a page steps, its last report and what its steps cost.
class PageRun {
 public:
  /// Takes another simulation, at the beginning of its run, or on its way with the motion of the
  /// one before: what a hand did there is not watched until it has calmed down.
  void take(std::unique_ptr<Simulation> fresh);
  /// Begins the run anew.
  void reset();
  /// Begins the run anew from these places (Simulation::start_from).
  void start_from(const Positions& places);

  /// Lets go of the grabbed vertex. What a hand does is no fault of the run: it is watched anew
  /// when the cloth has calmed down, after a second.
  void release_grab();

  bool is_loaded() const { return simulation_ != nullptr; }
  /// Throws InputError when nothing is loaded.
  Simulation& running() const;

  /// Makes so many steps, fewer when the numbers end the run, and then calls `show`. Returns 0, or
  /// the status that ended the run: an exception of either ends it as well.
  int step(int n, const std::function<void()>& show);
  /// The last step's report.
  const SolveReport& report() const { return report_; }

  /// "status" and "message".
  void put_status(emscripten::val& envelope) const;
  /// "warnings": what the run shows that its scene cannot explain.
  void put_warnings(emscripten::val& envelope) const;
  /// "parts_ms" of the parts that took time, "steps_ms" and "steps_timed" since the run began.
  void put_costs(emscripten::val& envelope) const;

 private:
  void begin();
  void look();

  std::unique_ptr<Simulation> simulation_;
  std::optional<TimedRun> steps_;
  std::optional<RunWatch> watch_;  // none while a hand holds the cloth, and until it is calm
  double calm_ = 0;                // time from which it is [s]
  SolveReport report_;
};

}  // namespace pleat
