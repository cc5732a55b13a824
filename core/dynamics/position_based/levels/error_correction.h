#pragma once

#include <vector>

#include "core/dynamics/position_based/levels/coarse_levels.h"
#include "core/dynamics/position_based/levels/gathered_springs.h"

namespace pleat {

/// Corrections by coarse levels whose lengths are what the errors of springs ask for, cycle after
/// cycle of one solve.
///
/// A correction counts by the share that leaves least error at once, or by more while errors get
/// less from cycle to cycle: that share is too small where all is well, as an interpolated
/// correction has errors of its own, which the next sweep takes away. Where errors stay the levels
/// are asked for what no move can mend, such as springs that contradict each other, and more than
/// that share would add up.
class ErrorCorrection {
 public:
  ErrorCorrection() = default;
  /// levels  made for these springs
  ErrorCorrection(CoarseLevels<Float4> levels, const GatheredSprings& springs)
      : levels_(std::move(levels)), strains_after_(springs.n_strains()) {}

  bool empty() const { return strains_after_.empty(); }
  const CoarseLevels<Float4>& levels() const { return levels_; }

  /// Begins a solve.
  void begin();
  /// Corrects the moves once; arrays as of GatheredSprings. Allocates once.
  ///
  /// n_numbers  in the array of moves
  /// strains    of the springs there
  void correct(const GatheredSprings& springs, const float* begins, float* moves,
               std::size_t n_numbers, const float* strains, const CycleSmoothing& smoothing);

 private:
  CoarseLevels<Float4> levels_;
  std::vector<float> strains_after_;
  std::vector<float> moves_before_;
  double last_square_ = 0;    // of all errors, a cycle ago
  double trust_ = 0;          // the least share of a correction
  bool has_stalled_ = false;  // in this solve: trust does not grow again
};

}  // namespace pleat
