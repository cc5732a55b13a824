#include "core/dynamics/position_based/lanes/lane_projections.h"

namespace pleat {

LaneProjections::LaneProjections(const ClothModel& model, const LaneLayout& layout, SpringLaw law,
                                 double h)
    : springs_(model, layout, law, h),
      bends_(model, layout, h),
      hanging_(model, layout, law, h),
      n_constraints_(static_cast<int>(active_springs(model, law).size())) {
  for (const BendElement& bend : model.bends) n_constraints_ += bend.stiffness != 0 ? 1 : 0;
}

void LaneProjections::refresh_rest_lengths(const ClothModel& model) {
  springs_.refresh_rest_lengths(model);
  hanging_.refresh_rest_lengths(model);
}

void LaneProjections::solve(const LaneView& view, int rounds) {
  for (int round = 0; round < rounds; ++round) sweep(view, round == 0);
}

void LaneProjections::sweep(const LaneView& view, bool is_first) {
  if (is_first) {
    bends_.first_sweep(view);
    springs_.first_sweep(view);
    hanging_.first_sweep(view);
  } else {
    bends_.next_sweep(view);
    springs_.next_sweep(view);
    hanging_.next_sweep(view);
  }
}

double LaneProjections::squared_residual(const LaneView& view) {
  return springs_.squared_residual(view) + bends_.squared_residual(view) +
         hanging_.squared_residual(view);
}

double LaneProjections::squared_residual_before(const LaneView& view) {
  return springs_.squared_residual_before_sweeps(view) +
         bends_.squared_residual_before_sweeps(view) +
         hanging_.squared_residual_before_sweeps(view);
}

std::unique_ptr<Projections> lane_projections(const ClothModel& model, const MethodOptions&,
                                              const LaneLayout& layout, SpringLaw law, double h) {
  return std::make_unique<LaneProjections>(model, layout, law, h);
}

}  // namespace pleat
