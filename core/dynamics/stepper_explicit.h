#pragma once

#include "core/dynamics/stepper.h"

namespace pleat {

/// Symplectic Euler: v += h M^-1 f(x, v), then x += h v with the new v. First order; stable below a
/// bound only.
class StepperExplicit final : public Stepper {
 public:
  /// Throws InputError naming the bound when the given substeps are longer than it.
  StepperExplicit(ClothModel& model, const MethodOptions& options);

  void refresh() override {}

  /// The largest stable substep h [s]: at every vertex (2/m)(h^2 sum k + 2 h sum c) < 4 over the
  /// springs there, a bending element counting as s |w_i| sum |w_j| / 2 in place of k (Gershgorin's
  /// bound on the amplification). Infinite when nothing is stiff.
  static double largest_stable_step(const ClothModel& model);

 protected:
  SolveReport substep(State& state, double time_end, double h) override;

 private:
  Positions forces_;
  Positions positions_begin_;
};

}  // namespace pleat
