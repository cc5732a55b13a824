#pragma once

#include <string>

#include "cli/arguments.h"
#include "core/run/plan_maker.h"

namespace pleat {

/// Takes --patterns, --criterion and --cap.
PlanRecipe take_plan_recipe(Arguments& arguments);

/// Sets how much may be lost [m], or of curvature the sum of demands, to what --demand says.
void set_demand(PlanOptions& options, const std::string& text);

}  // namespace pleat
