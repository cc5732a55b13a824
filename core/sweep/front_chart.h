#pragma once

#include <span>
#include <string>

#include "core/sweep/bench_row.h"

namespace pleat {

/// An SVG of milliseconds per frame across and position error up, both logarithmic: a mark for each
/// row, one shape and colour per stepper, and the front as a line. Below it stand the references,
/// and in words every row that has no place there.
std::string front_chart(std::span<const BenchRow> rows);

}  // namespace pleat
