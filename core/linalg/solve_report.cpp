#include "core/linalg/solve_report.h"

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

}  // namespace pleat
