#include "core/dynamics/position_based/lanes/lane_projections.h"

namespace pleat {

LaneProjections::LaneProjections(const ClothModel& model, const LaneLayout& layout, SpringLaw law,
                                 double h)
    : springs_(model, layout, law, h), bends_(model, layout, h), hanging_(model, layout, law, h) {}

void LaneProjections::refresh_rest_lengths(const ClothModel& model) {
  springs_.refresh_rest_lengths(model);
  hanging_.refresh_rest_lengths(model);
}

void LaneProjections::sweep(const LaneView& view, bool is_first) {
  bends_.sweep(view, is_first);
  springs_.sweep(view, is_first);
  hanging_.sweep(view, is_first);
}

void LaneProjections::forget() {
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
