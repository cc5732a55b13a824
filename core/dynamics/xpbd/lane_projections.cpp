#include "core/dynamics/xpbd/bend_program.h"
#include "core/dynamics/xpbd/hanging_program.h"
#include "core/dynamics/xpbd/projections.h"
#include "core/dynamics/xpbd/spring_program.h"

namespace pleat {
namespace {

class LaneProjections final : public Projections {
 public:
  LaneProjections(const ClothModel& model, const LaneLayout& layout, SpringLaw law, double h)
      : springs_(model, layout, law, h),
        bends_(model, layout, h),
        hanging_(model, layout, law, h) {}

  void refresh_pins(const ClothModel&, const float*) override {}

  void refresh_rest_lengths(const ClothModel& model) override {
    springs_.refresh_rest_lengths(model);
    hanging_.refresh_rest_lengths(model);
  }

  void solve(const LaneView& view, int rounds) override {
    bends_.first_sweep(view);
    springs_.first_sweep(view);
    hanging_.first_sweep(view);
    for (int round = 1; round < rounds; ++round) {
      bends_.next_sweep(view);
      springs_.next_sweep(view);
      hanging_.next_sweep(view);
    }
  }

  double squared_residual(const LaneView& view) override {
    return springs_.squared_residual(view) + bends_.squared_residual(view) +
           hanging_.squared_residual(view);
  }

  double squared_residual_before(const LaneView& view) override {
    return springs_.squared_residual_before_sweeps(view) +
           bends_.squared_residual_before_sweeps(view) +
           hanging_.squared_residual_before_sweeps(view);
  }

 private:
  SpringProgram springs_;
  BendProgram bends_;
  HangingProgram hanging_;
};

}  // namespace

std::unique_ptr<Projections> lane_projections(const ClothModel& model, const MethodOptions&,
                                              const LaneLayout& layout, SpringLaw law, double h) {
  return std::make_unique<LaneProjections>(model, layout, law, h);
}

}  // namespace pleat
