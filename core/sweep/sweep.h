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
#include "core/sweep/work_estimate.h"

namespace pleat {

/// The identity of a sweep of this plan as JSON text: another plan, scene, fabric, core or commit
/// has another text. Throws InputError at /duration_s when a reference has too many steps.
std::string sweep_identity(const SweepPlan& plan, const std::string& commit);

/// Works through a plan in slices.
///
/// Every setting runs once with its parts timed, which gives its row, after the references that it
/// needs; then all settings run again in turn, n_repeats times, which gives the row its median
/// time. References that the store has by the first `advance` are not made.
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
  double progress() const { return passed_share(works()); }  ///< share of the work, in [0, 1]
  /// Estimated time in all [s], from what it took so far; nothing while there is nothing to tell it
  /// from.
  std::optional<double> estimated_seconds() const;
  /// Works for about `budget` [s]: a step is never cut.
  void advance(double budget);

  const SweepPlan& plan() const { return plan_; }
  /// A row for each setting measured so far, in the order of the plan.
  const std::vector<BenchRow>& rows() const { return rows_; }
  std::string message() const;  ///< work at hand, for people; empty when done
  /// Ids of the references that rows are compared with.
  std::vector<std::string> reference_ids() const;

  /// {"done", "progress", "estimated_s": a number or null, "rows", "front", "message"}.
  Json report() const;

 private:
  std::size_t n_settings() const { return plan_.settings.size(); }
  std::size_t n_runs() const {
    return n_settings() * (1 + static_cast<std::size_t>(plan_.n_repeats));
  }
  std::size_t setting() const { return n_done_ % n_settings(); }  // setting of the run at hand
  std::size_t round() const { return n_done_ / n_settings(); }
  bool in_first_round() const { return round() == 0; }
  bool run_is_left_out() const;

  void find_references();
  std::optional<std::size_t> missing_reference() const;
  void make_reference(std::size_t index, double budget);
  void work_on_run(double budget);
  std::optional<BenchRow> begin_run();
  BenchRow new_row(const Scene& scene) const;  // row of the setting at hand
  BenchRow measured_row() const;               // row of the run at hand
  void put_errors(BenchRow& row) const;
  void keep_row(BenchRow row);
  void keep_time(double ms_per_frame);
  void record_row(BenchRow row);
  void record_time(double ms_per_frame);
  void skip_left_out() {
    while (run_is_left_out()) ++n_done_;
  }
  bool take_line(std::string_view line);
  std::vector<ExpectedWork> works() const;

  SweepPlan plan_;
  ReferenceStore& store_;
  std::string commit_;
  std::function<void(const std::string&)> record_ = [](const std::string&) {};
  std::vector<double> times_;  // sample times [s]
  SweepReferences references_;
  std::vector<std::optional<Reference>> made_;  // reference of each recipe
  std::vector<bool> is_needed_;  // true for recipes that are compared with, or are to be made
  bool has_looked_ = false;      // true once the store was searched
  std::unique_ptr<ReferenceMaker> maker_;  // maker of the reference at hand
  std::unique_ptr<SampledRun> run_;        // the run at hand
  std::size_t n_done_ = 0;                 // runs, round by round
  std::vector<BenchRow> rows_;
  std::vector<std::vector<double>> run_times_;  // ms per frame of each setting's timed runs
  double seconds_ = 0;                          // worked so far
  double seconds_at_hand_ = 0;                  // time worked on the reference or the run at hand
  std::vector<std::optional<double>> reference_seconds_;  // time of each recipe
  std::vector<std::optional<double>> row_seconds_;        // time of each setting's first run
};

}  // namespace pleat
