#include "core/error/run_measures.h"

#include <algorithm>
#include <numeric>

#include "core/base/check.h"
#include "core/error/error_norms.h"

namespace pleat {
namespace {

double mean(const std::vector<double>& values) {
  if (values.empty()) return RunMeasures::kUnknown;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

RunMeasures run_measures(std::span<const RunRecord> runs, std::span<const Positions> reference,
                         const Eigen::VectorXd& weights) {
  PLEAT_CHECK(!runs.empty(), "at least one run");
  const RunRecord& first = runs.front();
  std::vector<double> medians;
  for (const RunRecord& run : runs) medians.push_back(median(run.frame_ms));
  RunMeasures measures;
  measures.ms_per_frame = median(medians);
  const auto [quickest, slowest] = std::minmax_element(medians.begin(), medians.end());
  measures.spread_ms = *slowest - *quickest;
  measures.rms_stretch = mean(first.rms_stretch);
  measures.largest_stretch = mean(first.largest_stretch);
  if (!first.rms_stretch.empty())
    measures.rms_stretch_worst_frame =
        *std::max_element(first.rms_stretch.begin(), first.rms_stretch.end());
  for (std::size_t t = 0; t < reference.size(); ++t)
    measures.position_errors.push_back(t < first.samples.size()
                                           ? position_error(first.samples[t], reference[t], weights)
                                           : RunMeasures::kUnknown);
  return measures;
}

double time_ratio(std::span<const RunRecord> runs, std::span<const RunRecord> others,
                  std::size_t turn_frames) {
  PLEAT_CHECK(turn_frames > 0, "at least one frame in a turn");
  std::vector<double> ratios;
  for (std::size_t r = 0; r < std::min(runs.size(), others.size()); ++r) {
    const std::vector<double>& own = runs[r].processor_ms;
    const std::vector<double>& other = others[r].processor_ms;
    const std::size_t n_frames = std::min(own.size(), other.size());
    for (std::size_t begin = 0; begin < n_frames; begin += turn_frames) {
      const std::size_t end = std::min(begin + turn_frames, n_frames);
      const auto turn = [&](const std::vector<double>& ms) {
        return median({ms.data() + begin, ms.data() + end});
      };
      ratios.push_back(turn(own) / turn(other));
    }
  }
  return median(ratios);
}

}  // namespace pleat
