#include "core/linalg/solve_report.h"

#include <algorithm>
#include <utility>

namespace pleat {

void SolveReport::add(SolveReport part) {
  iterations += part.iterations;
  relative_residual = std::max(relative_residual, part.relative_residual);
  if (part.ok() && (!ok() || part.message.empty())) return;
  status = part.status;
  message = std::move(part.message);
}

}  // namespace pleat
