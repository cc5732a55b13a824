#pragma once

#include <string>

#include "cli/arguments.h"
#include "core/refinement/refinement_plan.h"

namespace pleat {

/// That of --criterion, else the usual one.
PlanCriterion take_criterion(Arguments& arguments);

/// What --demand says: how much may be lost [m], or of curvature the sum of demands.
void set_demand(PlanOptions& options, const std::string& text);

}  // namespace pleat
