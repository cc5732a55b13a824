#pragma once

#include <optional>

#include "core/dynamics/implicit/contact_hold.h"
#include "core/dynamics/implicit/pair_hold.h"
#include "core/dynamics/implicit/velocity_solve.h"
#include "core/dynamics/stepper.h"

namespace pleat {

/// Backward Euler with one linearisation: (M + h C + h^2 K) dv = h (f - h K v), K the projected
/// stiffness and C the damping at the substep's start. First order, dissipative, stable for any
/// step that matters here.
///
/// Source: Baraff & Witkin, Large steps in cloth simulation, SIGGRAPH 1998.
class StepperImplicit : public Stepper {
 public:
  /// Throws InputError when the wanted solver is not available.
  StepperImplicit(ClothModel& model, const MethodOptions& options);

  void refresh() override { solve_.choose_pins(*matrix_); }

 protected:
  /// Takes parts of a model implicitly, see `take_implicitly`.
  StepperImplicit(ClothModel& model, const MethodOptions& options, int substeps);

  /// Makes the matrix for these elements; K, C and f above are theirs.
  void take_implicitly(const ClothModel& stiff);
  /// Adds the forces of all other elements [N].
  virtual void add_explicit_forces(const State&, PositionsRef) const {}

  SolveReport substep(State& state, double time_end, double h) final;

 private:
  void choose_pairs(const State& state, double time_end, double h);
  void hold(const State& state, double h);
  bool let_loose(const State& state, double h);
  void assemble(const State& state, double h);
  void add_air_resistance(double h);
  SolveReport solve(const State& state, double time_end, double h);

  const ClothModel* stiff_ = nullptr;
  std::optional<SystemMatrix> matrix_;
  std::optional<ContactHold> hold_;    // models with contact only
  std::optional<PairHold> pair_hold_;  // models with self-contact only
  VelocitySolve solve_;
  Positions forces_;      // right-hand side, in [N s] once scaled by h
  Positions velocities_;  // solved ones, before contact; models with contact of either kind only
};

}  // namespace pleat
