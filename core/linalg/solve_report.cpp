#include "core/linalg/solve_report.h"

#include <algorithm>
#include <utility>

namespace pleat {

const char* name(SolveStatus status) {
  switch (status) {
    case SolveStatus::ok:
      return "ok";
    case SolveStatus::not_converged:
      return "not_converged";
    case SolveStatus::not_positive_definite:
      return "not_positive_definite";
    case SolveStatus::not_finite:
      return "not_finite";
  }
  return "";
}

void SolveReport::add(SolveReport part) {
  iterations += part.iterations;
  relative_residual = std::max(relative_residual, part.relative_residual);
  if (part.ok()) return;
  status = part.status;
  message = std::move(part.message);
}

}  // namespace pleat
