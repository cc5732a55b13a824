#pragma once

#include <array>

#include "core/dynamics/stepper.h"

namespace pleat {

/// The classical Runge-Kutta method on x' = v, v' = M^-1 f(x, v). Fourth order where the motion is
/// smooth; stable below a bound only (stability_bound.h). Pins have their own place and velocity at
/// every stage.
///
/// Source: Hairer, Norsett & Wanner, Solving ordinary differential equations I, Springer 1993,
/// II.1.
class StepperRk4 final : public Stepper {
 public:
  /// Throws InputError naming the bound when the given substeps are longer than it.
  StepperRk4(ClothModel& model, const MethodOptions& options);

  void refresh() override {}

 protected:
  SolveReport substep(State& state, double time_end, double h) override;

 private:
  /// Fills the rates of `state` at `time` [s], pins placed first.
  void evaluate(State& state, double time, State& rates);

  State stage_;
  std::array<State, 4> rates_;  // d/dt of positions [m/s] and velocities [m/s^2]
};

}  // namespace pleat
