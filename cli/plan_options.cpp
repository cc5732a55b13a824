#include "cli/plan_options.h"

#include "core/files/plan_file.h"

namespace pleat {

PlanRecipe take_plan_recipe(Arguments& arguments) {
  PlanRecipe recipe;
  recipe.patterns.n_patterns =
      arguments.whole_number("--patterns", 1, kMaxPatterns).value_or(recipe.patterns.n_patterns);
  recipe.plan.criterion = arguments.choice("--criterion", recipe.plan.criterion, kPlanCriteria);
  recipe.plan.level_cap = arguments.whole_number("--cap", 1, kMaxLevel);
  return recipe;
}

void set_demand(PlanOptions& options, const std::string& text) {
  const double number = parse_number(text, "--demand", Numbers::not_negative);
  (options.criterion == PlanCriterion::shape ? options.largest_loss : options.demand) = number;
}

}  // namespace pleat
