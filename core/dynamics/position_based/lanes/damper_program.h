#pragma once

#include <array>
#include <vector>

#include "core/dynamics/position_based/lane_layout.h"
#include "core/dynamics/position_based/lane_operations.h"
#include "core/dynamics/position_based/lanes/slot_sum.h"
#include "core/model/cloth_model.h"

namespace pleat {

/// The dampers beside a model's springs. Once a substep each brakes the velocities of its ends as
/// if it were alone, one after the other, four at a time where lanes allow. None adds kinetic
/// energy, however strong it is and whatever the substep; momentum is kept.
///
/// Source: docs/methods/xpbd.md, "Dampers".
class DamperProgram {
 public:
  /// h  substep [s]
  DamperProgram(const ClothModel& model, const LaneLayout& layout, double h);

  bool empty() const { return operations_.empty() && hanging_.empty(); }

  /// Brakes velocities, which are moves less `rounded_off`, by what it adds to the latter: places
  /// stay. Allocates nothing.
  void brake(const LaneView& view, const std::array<float*, 3>& rounded_off) const;

  /// Works on the lanes one after the other: same result, to hold the two against each other.
  void compute_lane_by_lane() {
    for (OperationStretch& stretch : stretches_) stretch.whole = false;
  }

 private:
  /// The first slots of the groups of both ends, and h c over the mean mass of the model's
  /// vertices; 0 in empty lanes.
  struct Operation {
    int a, b;
    PerLane<float> strengths;
  };
  /// A damper of an end that hangs, which moves the parents.
  struct JoinedDamper {
    SlotSum sum;
    float strength;
  };

  template <DampingDirection direction>
  void brake_in_lanes(const LaneView& view, const std::array<float*, 3>& rounded_off) const;
  template <DampingDirection direction>
  void brake_hanging(const LaneView& view, const std::array<float*, 3>& rounded_off) const;

  DampingDirection direction_;
  std::vector<Operation> operations_;
  std::vector<LaneMembers> members_;
  std::vector<OperationStretch> stretches_;
  std::vector<JoinedDamper> hanging_;
};

}  // namespace pleat
