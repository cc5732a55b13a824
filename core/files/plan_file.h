#pragma once

#include <array>
#include <string>
#include <string_view>

#include "core/files/json_reader.h"
#include "core/refinement/refinement_plan.h"

namespace pleat {

inline constexpr std::array<Word<PlanCriterion>, 2> kPlanCriteria{
    {{"shape", PlanCriterion::shape}, {"curvature", PlanCriterion::curvature}}};

/// A refinement plan as JSON (docs/methods/multiresolution.md), from which the same plan is read to
/// the bit.
std::string plan_text(const RefinementPlan& plan);
Json json_plan(const RefinementPlan& plan);

/// Throws InputError with the JSON pointer for anything that is not a plan. Whether it is one for
/// some mesh shows in planned_mesh.
RefinementPlan read_plan(std::string_view json_text);
RefinementPlan read_plan(const JsonReader& root);

}  // namespace pleat
