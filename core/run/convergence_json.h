#pragma once

#include "core/files/json_reader.h"
#include "core/run/convergence_study.h"

namespace pleat {

/// What a page wishes of a study: "time_s", "constraints", "most_rounds", "longest_solve_s",
/// "repeat", and "methods", each as the section "method" of a scene.
ConvergenceOptions read_convergence_options(const JsonReader& reader);

/// What is not known is null.
Json json_convergence(const ConvergenceStudy& study);

}  // namespace pleat
