#pragma once

#include "core/dynamics/implicit/stability_split.h"
#include "core/dynamics/implicit/stepper_implicit.h"

namespace pleat {

/// The least number of substeps, from the given one up, with which the wanted share of springs is
/// explicit. Throws InputError where none makes it so.
int imex_substeps(const ClothModel& model, const MethodOptions& options);

/// Implicit for the springs that need it at this substep, explicit for the others:
///
///     (M + h C_I + h^2 K_I) dv = h (f_E + f_I - h K_I v),   x += h v with the new v
///
/// with the forces f_E of the soft elements and all others, and f_I, projected stiffness K_I and
/// damping C_I of the stiff ones. Backward Euler with one linearisation where all are stiff,
/// symplectic Euler where none is. First order. The matrix has blocks of the stiff elements alone;
/// its pattern lasts until the set changes. Source: docs/methods/imex.md.
class StepperImex final : public StepperImplicit {
 public:
  /// Throws InputError when the wanted solver is not available, or no number of substeps makes the
  /// wanted share of springs explicit.
  StepperImex(ClothModel& model, const MethodOptions& options);

  void refresh() override { choose(); }
  void refresh_rest_lengths() override { choose(); }
  std::span<const char> implicit_springs() const override { return parts_.is_stiff; }

  const StabilitySplit& parts() const { return parts_; }

 private:
  void choose();
  void add_explicit_forces(const State& state, PositionsRef forces) const override;

  StabilitySplit parts_;
};

}  // namespace pleat
