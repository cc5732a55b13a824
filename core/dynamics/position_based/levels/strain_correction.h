#pragma once

#include <vector>

#include "core/dynamics/position_based/levels/coarse_levels.h"
#include "core/dynamics/position_based/levels/gathered_springs.h"

namespace pleat {

/// Corrects the springs of the finest level by coarse levels whose lengths are what the springs'
/// strains ask for, cycle after cycle of one solve.
///
/// A share of each correction counts: the one that leaves least strain at once, but no less than a
/// least share, which doubles from cycle to cycle until strains stall. An interpolated correction
/// has errors that the next sweep takes away, so that the best share at once is too small. Where
/// strains stall, springs contradict each other: the least share is halved.
class StrainCorrection {
 public:
  StrainCorrection() = default;
  /// levels  made for these springs
  StrainCorrection(CoarseLevels<Float4> levels, const GatheredSprings& springs)
      : levels_(std::move(levels)), strains_after_(springs.n_strains()) {}

  bool empty() const { return strains_after_.empty(); }
  const CoarseLevels<Float4>& levels() const { return levels_; }

  /// Begins a solve.
  void begin();
  /// Corrects the moves, so many numbers, by the springs' strains there; arrays as of
  /// GatheredSprings. Allocates once.
  void correct(const GatheredSprings& springs, const float* begins, float* moves,
               std::size_t n_numbers, const float* strains, const CycleSmoothing& smoothing);

 private:
  CoarseLevels<Float4> levels_;
  std::vector<float> strains_after_;
  std::vector<float> moves_before_;
  double last_square_ = 0;    // sum over all strains, a cycle ago
  double least_share_ = 0;    // least share of a correction that counts
  bool has_stalled_ = false;  // the least share does not grow again in this solve
};

}  // namespace pleat
