#pragma once

#include "cli/arguments.h"

namespace pleat {

/// How a command ended; bad input throws InputError instead.
enum class Outcome {
  ok,
  check_failed,  ///< it ran, but something it looked at is not as it should be
};

Outcome run_command(Arguments arguments);
Outcome sweep_command(Arguments arguments);
Outcome reference_command(Arguments arguments);
Outcome refine_command(Arguments arguments);
Outcome bench_command(Arguments arguments);
Outcome deform_command(Arguments arguments);
Outcome modes_command(Arguments arguments);
Outcome inbetween_command(Arguments arguments);
Outcome hierarchy_command(Arguments arguments);
Outcome convergence_command(Arguments arguments);
Outcome hard_cases_command(Arguments arguments);
Outcome bench_deform(Arguments arguments);     ///< bench deform
Outcome bench_inbetween(Arguments arguments);  ///< bench inbetween
Outcome bench_plans(Arguments arguments);      ///< bench plans
Outcome bench_together(Arguments arguments);   ///< bench together
Outcome bench_restarts(Arguments arguments);   ///< bench restarts
Outcome bench_rows(Arguments arguments);       ///< bench rows
Outcome bench_limit(Arguments arguments);      ///< bench limit
Outcome bench_response(Arguments arguments);   ///< bench response

}  // namespace pleat
