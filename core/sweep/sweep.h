#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/sweep/bench_row.h"
#include "core/sweep/sweep_plan.h"
#include "core/sweep/sweep_reference.h"

namespace pleat {

/// The identity of a sweep of this plan as JSON text: another plan, scene, fabric, core or commit
/// has another text. Throws InputError at /duration_s when a reference has too many steps.
std::string sweep_identity(const SweepPlan& plan, const std::string& commit);

/// Works through a plan in slices, so that a page can show progress and give up at any time.
///
/// Every setting runs once with its parts timed, which gives its row, after the references that it
/// needs; then all settings run again in turn, n_repeats times, which gives the row its median
/// time. A row's numbers other than times and memory do not depend on the slicing.
///
/// Every finished run is a line of a journal. A sweep that resumes one runs only what is missing.
class Sweep {
 public:
  /// store   outlives the sweep
  /// commit  what is being measured, for the rows
  /// Throws InputError at /duration_s when a reference has too many steps.
  Sweep(SweepPlan plan, ReferenceStore& store, std::string commit);

  /// Takes over the runs that the journal of a sweep of equal identity holds, up to the first
  /// line that is not whole or not of this sweep. Returns the size of what was taken [bytes]; the
  /// journal goes on behind it. Only before the first `advance`.
  std::size_t resume(std::string_view journal);

  /// `record` gets the journal's next line with its end of line when a run is finished.
  void on_run(std::function<void(const std::string& line)> record) { record_ = std::move(record); }

  bool done() const { return n_done_ == n_runs(); }
  /// Counts the first round, in which parts are timed, and the repeats.
  int n_rounds_done() const { return static_cast<int>(n_done_ / n_settings()); }
  double progress() const;  ///< share of the expected work, in [0, 1]
  /// Works for about `budget` [s]: a step is never cut.
  void advance(double budget);

  const SweepPlan& plan() const { return plan_; }
  /// A row for each setting measured so far, in the order of the plan.
  const std::vector<BenchRow>& rows() const { return rows_; }
  std::string message() const;  ///< what is being worked on, for people; empty when done

  /// {"done", "progress", "rows", "front", "message"}.
  Json report() const;

 private:
  std::size_t n_settings() const { return plan_.settings.size(); }
  std::size_t n_runs() const {
    return n_settings() * (1 + static_cast<std::size_t>(plan_.n_repeats));
  }
  std::size_t setting() const { return n_done_ % n_settings(); }  // of the run at hand
  std::size_t round() const { return n_done_ / n_settings(); }
  bool in_first_round() const { return round() == 0; }
  bool run_is_left_out() const;

  std::optional<std::size_t> missing_reference() const;
  void make_reference(std::size_t index, double budget);
  void work_on_run(double budget);
  std::optional<BenchRow> begin_run();
  BenchRow new_row(const Scene& scene) const;  // for the setting at hand
  BenchRow measured_row() const;               // from the run at hand
  void put_errors(BenchRow& row) const;
  void keep_row(BenchRow row);
  void keep_time(double ms_per_frame);
  void record_row(BenchRow row);
  void record_time(double ms_per_frame);
  void skip_left_out();
  bool take_line(std::string_view line);

  SweepPlan plan_;
  ReferenceStore& store_;
  std::string commit_;
  std::function<void(const std::string&)> record_ = [](const std::string&) {};
  std::vector<double> times_;  // of samples [s]
  SweepReferences references_;
  std::vector<std::optional<Reference>> made_;  // by recipe
  std::unique_ptr<ReferenceMaker> maker_;       // of the reference at hand
  std::unique_ptr<SampledRun> run_;             // the run at hand
  std::size_t n_done_ = 0;                      // runs, round by round
  std::vector<BenchRow> rows_;
  std::vector<std::vector<double>> run_times_;  // by setting: ms per frame of its timed runs
};

}  // namespace pleat
