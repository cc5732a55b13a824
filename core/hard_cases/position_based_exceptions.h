#pragma once

#include <vector>

#include "core/hard_cases/hard_case.h"

namespace pleat {

/// Adds to each case what pbd, hpbd and multigrid need not meet there by their nature: they project
/// rigid constraints one after another, in single precision.
void except_position_based(std::vector<HardCase>& cases);

}  // namespace pleat
