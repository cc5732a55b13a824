#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/dynamics/stepper_table.h"
#include "core/reference/reference.h"
#include "core/run/run_watch.h"

namespace pleat {

/// One setting measured: what it costs and how wrong it is, never one without the other. A setting
/// that failed is a row with its status; what could not be measured is NaN, in JSON null.
struct BenchRow {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  /// Throws ContractError without a reference id.
  explicit BenchRow(ReferenceLabel against);

  std::string scene;
  Json setting = Json::object();  ///< changes to its plan's scene: {pointer: value}
  Json fabric = Json::object();   ///< section of the scene, as the next
  Json model = Json::object();
  MethodOptions method;
  int level = 0;
  int n_vertices = 0;
  int n_substeps = 0;             ///< substeps of a step, as run
  int n_unresolved_contacts = 0;  ///< see ContactPass::n_unresolved

  double ms_per_frame = kUnknown;  ///< wall time per simulated 1/60 s, median of the runs [ms]
  double spread_ms = kUnknown;     ///< slowest minus quickest run of ms_per_frame [ms]
  int n_runs = 0;  ///< timed; each from a state built anew, its first step not counted
  std::array<double, kPartCount> parts_ms{};  ///< parts of a frame, from a run of its own [ms]

  double position_error = kUnknown;          ///< RMS over the cloth and the sample times [m]
  double position_error_percent = kUnknown;  ///< share of the rest diagonal [%]
  double position_error_95 = kUnknown;       ///< see RunErrors [m]
  /// Position error against the converged motion of the row's own mesh: the method's fault [m].
  double method_error = kUnknown;
  /// Distance of that motion from the reference: the mesh's fault [m].
  double mesh_error = kUnknown;
  double surface_error = kUnknown;          ///< see RunErrors, as are the next three [m]
  double surface_error_95 = kUnknown;       ///< [m]
  double bend_error = kUnknown;             ///< error of the distribution of curvature [1/m]
  double bend_error_of_regions = kUnknown;  ///< [1/m]
  double rms_stretch = kUnknown;            ///< RMS over structural springs and sample times
  double largest_stretch = kUnknown;
  double rms_stretch_error = kUnknown;  ///< minus the reference's
  double largest_stretch_error = kUnknown;
  /// Largest residual of the steps' own equations; unknown where none was computed, as by a direct
  /// solver.
  double residual = kUnknown;
  double iterations_per_step = kUnknown;
  double energy_drift = kUnknown;  ///< unexplained energy over the largest kinetic energy
  /// See RunWatch, at the end; unknown for cloth that has not come to rest.
  double unbalanced_share = kUnknown;

  ReferenceLabel reference;
  std::string status = "ok";  ///< or the name of a SolveStatus, or "refused"
  std::string message;
  std::string target;  ///< "native" or "wasm"
  std::string commit;  ///< commit that was measured
  /// Signs in the run that its scene cannot explain, looked for while parts were timed.
  std::vector<RunWarning> warnings;
  /// Peak memory of the whole process, with that of earlier rows [bytes], where the platform tells.
  std::optional<std::int64_t> process_peak_memory;

  /// False for a run that was refused or ended early: such a row is on no front.
  bool finished() const { return status == "ok" || status == "not_converged"; }
  /// False for a run that shows nonsense: such a row is on no front either, as an explosion is
  /// never the cheapest good point.
  bool is_plausible() const;
  double ms_per_simulated_second() const { return 60 * ms_per_frame; }
};

/// The parts of a step with their names, as a row has them.
Json json_parts(const std::array<double, kPartCount>& parts_ms);

Json json_bench_row(const BenchRow& row);

/// Throws InputError with the JSON pointer; a row without a reference id is refused.
BenchRow read_bench_row(const JsonReader& reader, StepperTable steppers = standard_steppers());

/// Indices of the rows on a front of milliseconds and position error, from cheap to dear. Errors
/// against different references are not comparable: each has a front of its own. A row that ended
/// early or shows nonsense is on none.
std::vector<std::vector<std::size_t>> fronts_of(std::span<const BenchRow> rows);

/// Indices of the rows on all fronts, one front behind the other.
std::vector<std::size_t> front_of(std::span<const BenchRow> rows);

/// A row's setting for people: method, level, and what else it changes.
std::string setting_phrase(const BenchRow& row);

/// Rows as a Markdown table, those on the front and those of nonsense marked, with a column for
/// each pointer that varies and for each part of a step that took time; below it, what marks, gaps
/// and a row's status mean.
std::string markdown_table(std::span<const BenchRow> rows);

}  // namespace pleat
