#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/simd.h"

namespace pleat {

/// Tells which moving solids four vertices of a group may meet in a substep, from how far apart
/// they were when that was last looked at, and how far both have moved since.
///
/// It errs to one side only, as DistanceBudget does for one vertex. Source:
/// docs/methods/contact.md, "In lanes".
class GroupFreedom {
 public:
  /// Knows nothing: every solid may be met by every group.
  void restart(int n_groups, int n_solids);

  /// shifts   how far any point of a solid moves, seen from a frame that drifts [m]; one per solid
  /// stretch  of ways within the substep, for the turns of the solids
  void begin_substep(std::span<const float> shifts, float stretch);

  /// Spends the substep of a group, whose longest way in the drifting frame this is [m], and calls
  /// meet(solid) for each that it may meet.
  template <class Meet>
  void spend(int group, float way, const Meet& meet) {
    float* const free = of(group);
    for (int solid = 0; solid < n_padded_; solid += Float4::kLanes) {
      const Float4 spent = Float4::all(way) + Float4::load(shifts_.data() + solid);
      const Float4 left = Float4::load(free + solid);
      (left - spent).store(free + solid);
      const int lanes = positive_lanes(Float4::all(stretch_) * spent - left);
      if (lanes == 0) continue;
      for (int lane = 0; lane < Float4::kLanes; ++lane)
        if (lanes >> lane & 1) meet(solid + lane);
    }
  }

  /// Distance by which both may come nearer to each other in the substep [m].
  float spent(int solid, float way) const { return way + shifts_[static_cast<std::size_t>(solid)]; }

  /// How much further than that they may come before the group meets the solid [m], at least.
  float left(int group, int solid, float way) const {
    return of(group)[solid] - (stretch_ - 1) * spent(solid, way);
  }

  /// How far the group is from the solid at the substep's end [m], at least.
  void set(int group, int solid, float distance) { of(group)[solid] = distance; }

  /// Spends a further way of the group [m]; infinite where nothing is known of it.
  void spend_more(int group, float way) {
    for (int solid = 0; solid < n_padded_; ++solid) of(group)[solid] -= way;
  }

 private:
  float* of(int group) { return free_.data() + static_cast<std::ptrdiff_t>(group) * n_padded_; }
  const float* of(int group) const {
    return free_.data() + static_cast<std::ptrdiff_t>(group) * n_padded_;
  }

  int n_padded_ = 0;  // solids, and what fills up lanes
  float stretch_ = 1;
  std::vector<float> shifts_;  // [m]
  std::vector<float> free_;    // solid by solid, group by group [m]
};

}  // namespace pleat
