#include "core/dynamics/position_based/lanes/lane_projections.h"

namespace pleat {

LaneProjections::LaneProjections(const ClothModel& model, const LaneLayout& layout, SpringLaw law,
                                 double h)
    : springs_(model, layout, law, h), bends_(model, layout, h), hanging_(model, layout, law, h) {}

void LaneProjections::refresh_rest_lengths(const ClothModel& model) {
  springs_.refresh_rest_lengths(model);
  hanging_.refresh_rest_lengths(model);
}

void LaneProjections::solve(const LaneView& view, int rounds) {
  const bool needs_none = rounds == 1 && !keeps_multipliers_;
  for (int round = 0; round < rounds; ++round)
    sweep(view, needs_none   ? Multipliers::passing
                : round == 0 ? Multipliers::begun
                             : Multipliers::kept);
  keeps_multipliers_ = false;
}

void LaneProjections::sweep(const LaneView& view, Multipliers of_bends) {
  const bool is_first = of_bends != Multipliers::kept;
  bends_.sweep(view, of_bends);
  springs_.sweep(view, is_first);
  hanging_.sweep(view, is_first);
}

void LaneProjections::forget() {
  keeps_multipliers_ = true;
  springs_.forget();
  bends_.forget();
  hanging_.forget();
}

double LaneProjections::squared_residual(const LaneView& view) {
  return springs_.squared_residual(view) + bends_.squared_residual(view) +
         hanging_.squared_residual(view);
}

std::unique_ptr<Projections> lane_projections(const ClothModel& model, const MethodOptions&,
                                              const LaneLayout& layout, SpringLaw law, double h) {
  return std::make_unique<LaneProjections>(model, layout, law, h);
}

}  // namespace pleat
