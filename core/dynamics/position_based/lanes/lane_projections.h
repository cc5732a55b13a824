#pragma once

#include "core/dynamics/position_based/lanes/bend_program.h"
#include "core/dynamics/position_based/lanes/hanging_program.h"
#include "core/dynamics/position_based/lanes/spring_program.h"
#include "core/dynamics/position_based/projections.h"

namespace pleat {

/// Projections in the order of the lanes: the bending of whole threads and lines of springs at
/// once, everything else one after the other. A round is a sweep over all constraints.
class LaneProjections final : public Projections {
 public:
  /// h  substep [s]
  LaneProjections(const ClothModel& model, const LaneLayout& layout, SpringLaw law, double h);

  void refresh_pins(const ClothModel&, const float* inverse_masses) override {
    bends_.refresh_pins(inverse_masses);
  }
  void refresh_rest_lengths(const ClothModel& model) override;

  void solve(const LaneView& view, int rounds) override;
  /// One round; the first of a substep starts from multipliers of zero.
  void sweep(const LaneView& view, bool is_first) {
    sweep(view, is_first ? Multipliers::begun : Multipliers::kept);
  }

  double sweeps_per_round() const override { return 1; }

  double squared_residual(const LaneView& view) override;
  void forget() override;

 private:
  void sweep(const LaneView& view, Multipliers of_bends);

  bool keeps_multipliers_ = false;  // the next solve does
  SpringProgram springs_;
  BendProgram bends_;
  HangingProgram hanging_;
};

/// Makes them for `xpbd`.
std::unique_ptr<Projections> lane_projections(const ClothModel& model, const MethodOptions& options,
                                              const LaneLayout& layout, SpringLaw law, double h);

}  // namespace pleat
