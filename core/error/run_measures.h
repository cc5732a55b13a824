#pragma once

#include <limits>
#include <span>
#include <vector>

#include "core/base/vec.h"

namespace pleat {

/// Cost, stretch and shapes of one run of a scene, whichever program computed it.
struct RunRecord {
  std::vector<double> frame_ms;         ///< wall time of each frame but the first [ms]
  std::vector<double> processor_ms;     ///< processor time of the same frames [ms]
  std::vector<double> rms_stretch;      ///< RMS stretch of each frame
  std::vector<double> largest_stretch;  ///< largest stretch of each frame
  std::vector<Positions> samples;       ///< [m], at the times that are compared
};

/// Cost and error of one program on one scene. NaN: not measured.
struct RunMeasures {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  double ms_per_frame = kUnknown;     ///< median over the runs of the median frame [ms]
  double spread_ms = kUnknown;        ///< slowest minus quickest of the runs' median frames [ms]
  double rms_stretch = kUnknown;      ///< mean over the frames
  double largest_stretch = kUnknown;  ///< mean over the frames of each one's largest
  double rms_stretch_worst_frame = kUnknown;
  /// RMS distance at each of the times; NaN where the run did not come that far [m].
  std::vector<double> position_errors;
};

/// runs       of the same scene, at least one: times are of all, the rest is of the first
/// reference  positions that are taken for right, at each of the times [m]
/// weights    of the vertices that both have, as of position_error
RunMeasures run_measures(std::span<const RunRecord> runs, std::span<const Positions> reference,
                         const Eigen::VectorXd& weights);

/// How many times as long as `others` the `runs` took that took turns with them, `turn_frames`
/// frames at a time: the median over the turns of the ratio of the median frames, in processor
/// time.
///
/// Turns next to each other meet the machine at the same speed, and the medians, of pairs, pass
/// over what was slowed down. NaN without a turn that both have done.
double time_ratio(std::span<const RunRecord> runs, std::span<const RunRecord> others,
                  std::size_t turn_frames);

}  // namespace pleat
