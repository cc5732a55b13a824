#pragma once

#include <vector>

#include "core/hard_cases/hard_case.h"

namespace pleat {

/// Adds to each case what pbd, hpbd and multigrid do not meet there: what is so by their nature, as
/// they project rigid constraints one after another in single precision, and faults whose cause is
/// not known, which say so and, where the measure is finite, how large they may be.
void except_position_based(std::vector<HardCase>& cases);

}  // namespace pleat
