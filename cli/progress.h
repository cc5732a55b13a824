#pragma once

#include <string>

#include "core/run/simulation.h"
#include "core/run/stage_timer.h"

namespace pleat {

/// Tells on stderr how far something long has come: a line that is rewritten on a terminal, else a
/// line now and then.
class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// share  done, in [0, 1]
  void show(double share, const std::string& message);

 private:
  Stopwatch watch_;
  bool on_terminal_;
  double next_;  // when to speak again [s]
  bool line_is_open_ = false;
};

/// Says on stderr in which step the numbers ended a run, why, and what comes of it.
void print_early_end(const Simulation& simulation, const SolveReport& report,
                     const char* consequence);

}  // namespace pleat
