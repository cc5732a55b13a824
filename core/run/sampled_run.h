#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "core/model/stretch.h"
#include "core/run/run_ledger.h"
#include "core/run/run_watch.h"
#include "core/run/simulation.h"
#include "core/run/timed_run.h"

namespace pleat {

/// Shape of the cloth at one time of a run.
struct Sample {
  double time;          ///< [s]
  Positions positions;  ///< [m]
  Stretch stretch;
  /// How far halving the step or mesh moved a reference, RMS [m]; NaN where neither was halved.
  double uncertainty = std::numeric_limits<double>::quiet_NaN();
};

/// A scene run from its start through given times, in slices.
///
/// When a sample time lies inside a step, positions come from the cubic through both ends'
/// positions and velocities, whose error is of fourth order in the step. Sampling is outside the
/// clock, and so is the first step, in which steppers build what they keep.
class SampledRun {
 public:
  /// Measurements beside the samples. Each costs time, or memory and caches: the clock's seconds
  /// are those of the method alone where the run is `untimed`.
  enum class Parts {
    untimed,            ///< nothing
    watched,            ///< warnings
    timed_with_ledger,  ///< the time of a step's parts, the account of its energy, and warnings
  };

  /// times  [s], positive, ascending, at least one.
  /// Throws InputError when the scene's method cannot run on it, and for cloth that tears.
  SampledRun(const Scene& scene, std::vector<double> times, Parts parts);
  SampledRun(const SampledRun&) = delete;
  SampledRun& operator=(const SampledRun&) = delete;

  /// True at the last sample, or when the numbers ended the run before.
  bool done() const { return failed() || samples_.size() == times_.size(); }
  bool failed() const { return run_.has_ended(); }

  /// Steps until done or until `budget` [s] is spent, at least once.
  void advance(double budget);

  /// Share of the steps done, in [0, 1].
  double progress() const { return done() ? 1 : std::min(1.0, simulation_.time() / times_.back()); }
  const Simulation& simulation() const { return simulation_; }
  const std::vector<double>& times() const { return times_; }
  const std::vector<Sample>& samples() const { return samples_; }
  /// ok, or what ended the run, or not_converged when that ever happened. Its residual is the
  /// largest of all steps, its iterations their sum.
  const SolveReport& report() const { return run_.report(); }
  double timed_seconds() const { return run_.seconds(); }  ///< wall time [s]
  /// Simulated time of these [s].
  double timed_duration() const {
    return static_cast<double>(run_.n_timed()) * simulation_.scene().method.step;
  }
  /// Times of the same steps' parts; zero unless timed.
  const PartTimer& parts() const { return run_.parts(); }
  /// See EnergyLedger; NaN without it.
  double relative_drift() const {
    return ledger_ ? ledger_->account().relative_drift() : std::numeric_limits<double>::quiet_NaN();
  }
  /// See RunWatch, which looks at each step; none when untimed.
  std::vector<RunWarning> warnings() const {
    return watch_ ? watch_->warnings() : std::vector<RunWarning>();
  }
  /// See RunWatch, after the last sample; NaN without it and where nothing came to rest.
  double unbalanced_share() const {
    return watch_ ? watch_->unbalanced_share() : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  void step();
  void take_samples(const State& begin, double time_begin);
  bool sample_is_due() const;

  Simulation simulation_;
  TimedRun run_;
  std::vector<double> times_;
  std::vector<Sample> samples_;
  State begin_;
  std::optional<RunLedger> ledger_;
  std::optional<RunWatch> watch_;
};

}  // namespace pleat
