#pragma once

#include "core/dynamics/stepper.h"

namespace pleat {

/// Largest step of symplectic Euler that is surely stable [s]: h^2 k + 2 h c < 2 m for every
/// vertex, k and c summed over its elements (Gershgorin). Infinite without elements, 0 with hinges.
/// The classical Runge-Kutta method is stable in steps of this length too.
double largest_stable_step(const ClothModel& model);

/// Substeps of a step of an explicit method: as many as the options say, or, when they leave it
/// open, as many as the bound needs. Throws InputError for steps beyond the bound and for cloth
/// that would need more than kMaxSubsteps.
int stable_substeps(const ClothModel& model, const MethodOptions& options);

}  // namespace pleat
