#pragma once

#include "core/dynamics/implicit/contact_hold.h"
#include "core/dynamics/implicit/velocity_solve.h"
#include "core/dynamics/stepper.h"

namespace pleat {

/// Backward Euler with one linearisation: (M + h C + h^2 K) dv = h (f - h K v), K the projected
/// stiffness and C the damping at the substep's begin. First order, dissipative, stable for any
/// step that matters here.
///
/// Source: Baraff & Witkin, Large steps in cloth simulation, SIGGRAPH 1998.
class StepperImplicit final : public Stepper {
 public:
  /// Throws InputError when the wanted solver is not available.
  StepperImplicit(ClothModel& model, const MethodOptions& options);

  void refresh() override { solve_.choose_pins(matrix_); }

 protected:
  SolveReport substep(State& state, double time_end, double h) override;

 private:
  void assemble(const State& state, double h);

  SystemMatrix matrix_;
  std::optional<ContactHold> hold_;  // with contact
  VelocitySolve solve_;
  Positions forces_;  // right-hand side, in [N s] once scaled by h
  Positions positions_begin_;
};

}  // namespace pleat
