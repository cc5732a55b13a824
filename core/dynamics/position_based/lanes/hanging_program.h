#pragma once

#include <vector>

#include "core/dynamics/position_based/lane_layout.h"
#include "core/dynamics/position_based/lanes/slot_sum.h"
#include "core/dynamics/position_based/spring_law.h"

namespace pleat {

/// The springs and bending elements of a model that join hanging vertices, as constraints on the
/// vertices that do not hang: C(S y). Each sees what those before it did, and so do the hanging
/// vertices. One at a time, for they are few.
class HangingProgram {
 public:
  /// h  substep [s]
  HangingProgram(const ClothModel& model, const LaneLayout& layout, SpringLaw law, double h);

  /// Takes over changed rest lengths. Allocates nothing.
  void refresh_rest_lengths(const ClothModel& model);

  bool empty() const { return springs_.empty() && bends_.empty(); }

  /// Projects each element once; the first sweep of a substep starts from multipliers of zero.
  void sweep(const LaneView& view, bool is_first);
  /// Makes the multipliers zero.
  void forget();

  /// Sum of |C + compliance/h^2 lambda|^2 [m^2].
  double squared_residual(const LaneView& view) const;

 private:
  struct JoinedSpring {
    SlotSum sum;
    int spring;
    SpringBlock block;  // first lane only
  };
  struct JoinedBend {
    SlotSum sum;  // relative to the middle vertex's weight
    float compliance;
  };

  template <bool first>
  void sweep(const LaneView& view);
  template <bool first>
  void project_bends(const LaneView& view);
  template <SpringLaw law, bool first>
  void project_springs(const LaneView& view);

  SpringLaw law_;
  double h_;          // [s]
  double mean_mass_;  // [kg]
  std::vector<JoinedSpring> springs_;
  std::vector<JoinedBend> bends_;
  std::vector<float> spring_multipliers_;
  std::vector<float> bend_multipliers_;  // x, y, z per element
};

}  // namespace pleat
