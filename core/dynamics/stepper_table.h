#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/dynamics/stepper.h"
#include "core/dynamics/stepper_type.h"

namespace pleat {

/// Steppers in the order in which people are shown them.
using StepperTable = std::span<const StepperType* const>;

/// All that Pleat has.
StepperTable standard_steppers();

/// Null when the table has none of this name.
const StepperType* find_stepper(StepperTable table, std::string_view name);

/// Pleat's own settings, and then what else steppers of the table read.
std::vector<const MethodSetting*> all_settings(StepperTable table);

/// "implicit, projective, ...".
std::string stepper_names(StepperTable table);

/// A line or two for each stepper, with the settings it reads, for the command's help.
std::string stepper_help(StepperTable table);

/// The stepper that the options name. Throws InputError when the method cannot run on this model
/// (explicit or rk4 beyond the stability bound or kMaxSubsteps; a solver that this build or the
/// method does not have; projective or xpbd on anything but a plain lattice of springs; newton's
/// equilibrium with solids; friction inside the fabric with steppers that do not take it).
std::unique_ptr<Stepper> make_stepper(ClothModel& model, const MethodOptions& options);

}  // namespace pleat
