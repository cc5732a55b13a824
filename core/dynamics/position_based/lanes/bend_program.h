#pragma once

#include <algorithm>
#include <vector>

#include "core/dynamics/position_based/lane_layout.h"
#include "core/dynamics/position_based/spring_law.h"

namespace pleat {

/// The bending elements of a model that join no hanging vertex, compiled into operations on four at
/// a time. Each is one vector constraint, linear in the positions.
class BendProgram {
 public:
  /// h  substep [s]
  BendProgram(const ClothModel& model, const LaneLayout& layout, double h);

  /// Projects each element once; the first sweep of a substep starts from multipliers of zero.
  void sweep(const LaneView& view, bool is_first);
  /// Makes the multipliers zero.
  void forget() { std::fill(multipliers_.begin(), multipliers_.end(), 0.0f); }

  /// Sum of |C + compliance/h^2 lambda|^2 [m^2].
  double squared_residual(const LaneView& view) const;

  /// Works on the lanes one after the other: same result, to hold the two against each other.
  void compute_lane_by_lane() {
    for (OperationStretch& stretch : stretches_) stretch.whole = false;
  }

 private:
  struct Operation {
    int before, middle, after;
  };
  struct Block {
    PerLane<float> before{}, after{};    // weights relative to the middle one
    PerLane<float> compliance{};         // mean mass / (stiffness h^2); 0 in empty lanes
    PerLane<float> denominator_share{};  // softened; infinite in empty lanes: nothing moves there
  };

  template <bool first>
  void sweep(const LaneView& view);

  std::vector<Operation> operations_;
  std::vector<LaneMembers> members_;
  std::vector<Block> blocks_;  // one per operation
  std::vector<OperationStretch> stretches_;
  std::vector<float> multipliers_;  // x, y, z groups per operation
};

}  // namespace pleat
