#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/measure/bench_row.h"
#include "core/measure/sweep_plan.h"

namespace pleat {

/// Works through a plan in slices, so that a page can show progress and give up at any time.
///
/// First comes the reference. Then every setting runs once with its parts timed, which gives its
/// row; then all settings run again in turn, n_repeats times, which gives the row its median time.
/// A row's numbers other than times and memory do not depend on the slicing.
class Sweep {
 public:
  /// store   outlives the sweep
  /// commit  what is being measured, for the rows
  Sweep(SweepPlan plan, ReferenceStore& store, std::string commit);

  bool done() const { return n_done_ == n_tasks(); }
  double progress() const;  ///< share of the expected work, in [0, 1]
  /// Works for about `budget` [s]: a step is never cut.
  void advance(double budget);

  const SweepPlan& plan() const { return plan_; }
  /// Of the settings measured so far: levels in the order of the plan, methods within.
  const std::vector<BenchRow>& rows() const { return rows_; }
  std::string message() const;  ///< what is being worked on, for people; empty when done

  /// {"done", "progress", "rows", "front", "message"} as JSON text.
  std::string report_json() const;

 private:
  int n_tasks() const { return 1 + plan_.n_settings() * (1 + plan_.n_repeats); }
  bool in_reference() const { return n_done_ == 0; }
  std::size_t setting() const;  // of the task at hand
  bool in_first_round() const { return n_done_ <= plan_.n_settings(); }
  Scene setting_scene(std::size_t setting) const;
  double expected_work(int task) const;

  void make_reference(double budget);
  void work_on_setting(double budget);
  void begin_run();
  BenchRow new_row() const;       // for the setting at hand
  BenchRow measured_row() const;  // from the run at hand
  void add_time();                // of the run at hand

  SweepPlan plan_;
  ReferenceStore& store_;
  std::string commit_;
  std::vector<double> times_;  // of samples [s]
  Reference reference_;
  std::unique_ptr<SampledRun> run_;  // the task at hand
  int n_done_ = 0;                   // tasks: the reference, then round by round
  std::vector<BenchRow> rows_;
  std::vector<std::vector<double>> run_times_;  // by setting: ms per frame of its timed runs
};

}  // namespace pleat
