#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/dynamics/stepper.h"
#include "core/run/moving_cloth.h"
#include "core/scene/scene.h"

namespace pleat {

/// A scene's stepper called on masses, springs, pins and weight, with nothing around it: what a
/// Simulation of the same scene takes beyond it is the price of what the scene does not ask for.
class BareCloth final : public MovingCloth {
 public:
  /// Throws InputError unless these are all that the scene asks for.
  explicit BareCloth(const Scene& scene);

  SolveReport step() override;
  const State& state() const override { return state_; }
  const ClothModel& model() const override { return model_; }
  const std::vector<GaugeEdge>& gauge() const override { return gauge_; }
  const QuadMesh* mesh() const override { return nullptr; }
  double time() const override { return static_cast<double>(n_steps_) * step_; }
  int substeps() const { return stepper_->substeps(); }
  void observe(PartObserver* observer) override { stepper_->observe(observer); }

 private:
  ClothModel model_;
  std::vector<GaugeEdge> gauge_;
  State state_;
  std::unique_ptr<Stepper> stepper_;
  double step_;  // [s]
  std::int64_t n_steps_ = 0;
};

}  // namespace pleat
