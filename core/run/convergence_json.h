#pragma once

#include "core/files/json_reader.h"
#include "core/run/convergence_study.h"

namespace pleat {

/// Reads a page's request: "time_s", "constraints", "most_rounds", "longest_solve_s", "repeat", and
/// "methods", each as the section "method" of a scene.
ConvergenceOptions read_convergence_options(const JsonReader& reader);

/// The study as JSON; unknown numbers are null.
Json json_convergence(const ConvergenceStudy& study);

}  // namespace pleat
