#pragma once

#include <span>
#include <string>

#include "core/hard_cases/case_run.h"
#include "core/hard_cases/hard_case.h"

namespace pleat {

/// Cases down, steppers across, with what is told of outcomes that are not plainly ok; then what
/// each case is and what is asked of it. Markdown.
///
/// outcomes  of these cases, in any order
std::string case_tables(std::span<const HardCase> cases, std::span<const CaseOutcome> outcomes);

Json json_outcome(const CaseOutcome& outcome);

}  // namespace pleat
