#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/linalg/solve_report.h"
#include "core/run/part_timer.h"
#include "core/run/run_watch.h"

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

/// Work in slices of this length shows its progress in between [s].
constexpr double kProgressSlice = 0.1;

/// Brings work to its end that has `done`, `advance(budget)` and `progress`, and shows how far it
/// has come.
template <class Work>
void finish(Work& work, const std::string& message) {
  Progress progress;
  while (!work.done()) {
    work.advance(kProgressSlice);
    progress.show(work.progress(), message);
  }
}

/// Says each on stderr with what to try, and of which setting or example where that is not clear.
void tell_warnings(std::span<const RunWarning> warnings, const std::string& of = "");

/// Says on stderr in which step, after so many, the numbers ended a run, why, and what comes of it.
void print_early_end(std::int64_t n_steps, const SolveReport& report, const char* consequence);

}  // namespace pleat
