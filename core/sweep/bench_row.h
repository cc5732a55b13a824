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
  Json setting = Json::object();  ///< what it changes in its plan's scene: {pointer: value}
  Json fabric = Json::object();   ///< as a scene has it, and so the next
  Json model = Json::object();
  MethodOptions method;
  int level = 0;
  int n_vertices = 0;
  int n_substeps = 0;             ///< of a step, as run
  int n_unresolved_contacts = 0;  ///< see ContactStage::n_unresolved

  double ms_per_frame = kUnknown;  ///< wall time per simulated 1/60 s, median of the runs [ms]
  double spread_ms = kUnknown;     ///< of ms_per_frame, slowest minus quickest run [ms]
  int n_runs = 0;  ///< timed; each from a state built anew, its first step not counted
  std::array<double, kStageCount> parts_ms{};  ///< per frame, from a run of its own [ms]

  double position_error = kUnknown;          ///< RMS over the cloth and the sample times [m]
  double position_error_percent = kUnknown;  ///< of the rest diagonal
  double position_error_95 = kUnknown;       ///< see RunErrors [m]
  /// Position error against the converged motion of the row's own mesh: what its method does
  /// wrong [m].
  double method_error = kUnknown;
  /// How far that motion is from the reference: what the mesh does wrong [m].
  double mesh_error = kUnknown;
  double surface_error = kUnknown;          ///< see RunErrors, as are the next three [m]
  double surface_error_95 = kUnknown;       ///< [m]
  double bend_error = kUnknown;             ///< of the distribution of curvature [1/m]
  double bend_error_of_regions = kUnknown;  ///< [1/m]
  double rms_stretch = kUnknown;            ///< over structural springs and sample times
  double largest_stretch = kUnknown;
  double rms_stretch_error = kUnknown;  ///< minus the reference's
  double largest_stretch_error = kUnknown;
  /// Of the steps' own equations, the largest; unknown where it was not computed, as by a direct
  /// solver.
  double residual = kUnknown;
  double iterations_per_step = kUnknown;
  double energy_drift = kUnknown;  ///< what no force explains, of the largest kinetic energy

  ReferenceLabel reference;
  std::string status = "ok";  ///< or the name of a SolveStatus, or "refused"
  std::string message;
  std::string target;  ///< "native" or "wasm"
  std::string commit;  ///< what was measured
  /// What the run shows that its scene cannot explain, looked for while parts were timed.
  std::vector<RunWarning> warnings;
  /// Of the whole process, with what earlier rows needed [bytes], where the platform tells.
  std::optional<std::int64_t> process_peak_memory;

  /// False for a run that was refused or ended early: such a row is on no front.
  bool finished() const { return status == "ok" || status == "not_converged"; }
  /// False for a run that shows nonsense: such a row is on no front either, as an explosion is
  /// never the cheapest good point.
  bool is_plausible() const;
  double ms_per_simulated_second() const { return 60 * ms_per_frame; }
};

/// The parts of a step with their names, as a row has them.
Json json_parts(const std::array<double, kStageCount>& parts_ms);

Json json_bench_row(const BenchRow& row);

/// Throws InputError with the JSON pointer; a row without a reference id is refused.
BenchRow read_bench_row(const JsonReader& reader, StepperTable steppers = standard_steppers());

/// Indices of the rows on a front of milliseconds and position error, from cheap to dear. Errors
/// against different references are not comparable: each has a front of its own. A row that ended
/// early or shows nonsense is on none.
std::vector<std::vector<std::size_t>> fronts_of(std::span<const BenchRow> rows);

/// The same in one list, a front behind the other.
std::vector<std::size_t> front_of(std::span<const BenchRow> rows);

/// A row's setting for people: method, level, and what else it changes.
std::string setting_phrase(const BenchRow& row);

/// Rows as a Markdown table, those on the front and those of nonsense marked, with a column for
/// each pointer that varies and for each part of a step that took time; below it, what marks, gaps
/// and a row's status mean.
std::string markdown_table(std::span<const BenchRow> rows);

}  // namespace pleat
