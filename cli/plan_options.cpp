#include "cli/plan_options.h"

#include "core/base/check.h"
#include "core/files/plan_file.h"

namespace pleat {

PlanCriterion take_criterion(Arguments& arguments) {
  const auto name = arguments.text("--criterion");
  if (!name) return PlanOptions{}.criterion;
  for (const auto& [text, criterion] : kPlanCriteria)
    if (*name == text) return criterion;
  throw InputError("--criterion", "expected shape or curvature, got " + abbreviated(Json(*name)));
}

void set_demand(PlanOptions& options, const std::string& text) {
  const double number = parse_number_from_zero(text, "--demand");
  (options.criterion == PlanCriterion::shape ? options.largest_loss : options.demand) = number;
}

}  // namespace pleat
