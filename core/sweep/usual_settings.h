#pragma once

#include <vector>

#include "core/dynamics/stepper_table.h"
#include "core/scene/scene.h"

namespace pleat {

/// The settings of a stepper worth comparing, with the step of the scene's own method. What that
/// says of another stepper does not hold for this one.
std::vector<MethodOptions> usual_settings(const StepperType& type,
                                          const MethodOptions& scene_method);

/// The steppers of the table that are worth comparing on a scene: fast ones for springs, exact ones
/// for a membrane.
std::vector<const StepperType*> usual_steppers(StepperTable steppers, const Scene& scene);

}  // namespace pleat
