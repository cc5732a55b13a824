#pragma once

#include "core/dynamics/stepper.h"

namespace pleat {

/// Symplectic Euler: v += h M^-1 f(x, v), then x += h v with the new v; or forward Euler, with the
/// old v. First order; stable below a bound only (stability_bound.h).
class StepperExplicit final : public Stepper {
 public:
  /// Throws InputError naming the bound when the given substeps are longer than it.
  StepperExplicit(ClothModel& model, const MethodOptions& options);

  void refresh() override {}

 protected:
  SolveReport substep(State& state, double time_end, double h) override;

 private:
  Positions forces_;
};

}  // namespace pleat
