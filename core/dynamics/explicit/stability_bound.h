#pragma once

#include "core/dynamics/stepper.h"

namespace pleat {

/// Largest step of symplectic Euler that is surely stable [s]: h^2 k + 2 h c < 2 m for every
/// vertex, k and c summed over its elements (Gershgorin). Infinite without elements, 0 with hinges.
/// The classical Runge-Kutta method is stable in steps of this length too.
double largest_stable_step(const ClothModel& model);

/// Largest step of forward Euler that is surely stable [s]: h k <= c for every spring and h sum c
/// <= m for every vertex. With the shares c, k of a mode that swings, |1 + h lambda|^2 = 1 - h c +
/// h^2 k; one that only fades has |lambda| <= c. 0 where a spring or anything else is undamped, or
/// dampers leave rotations alone.
double largest_forward_step(const ClothModel& model);

/// The bound that holds for an explicit method with these options [s].
double stability_bound(const ClothModel& model, const MethodOptions& options);

/// Substeps of a step of an explicit method: as many as the options say, or, when they leave it
/// open, as many as the bound needs. Throws InputError for cloth that would need more than
/// kMaxSubsteps and, unless the options go on beyond it, for substeps beyond the bound.
int stable_substeps(const ClothModel& model, const MethodOptions& options);

}  // namespace pleat
