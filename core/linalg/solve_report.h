#pragma once

#include <string>

namespace pleat {

/// How a numeric task ended. The numbers report; they never throw.
enum class SolveStatus {
  ok,
  not_converged,          ///< the iteration cap was reached; the result is the best one so far
  not_positive_definite,  ///< the factorisation met a pivot that is not positive
  not_finite,  ///< NaN, infinity or a number beyond all bounds; the message names the first one
};

inline constexpr const char* kSolveStatusNames[] = {"ok", "not_converged", "not_positive_definite",
                                                    "not_finite"};

constexpr const char* name(SolveStatus status) {
  return kSolveStatusNames[static_cast<std::size_t>(status)];
}

struct SolveReport {
  SolveStatus status = SolveStatus::ok;
  int iterations = 0;            ///< 0 for direct methods
  double relative_residual = 0;  ///< residual of the equations that the task solves
  std::string message;           ///< when ok, empty, or what another method did in its place

  bool ok() const { return status == SolveStatus::ok; }
  /// True when the numbers cannot go on from the result.
  bool ends_run() const { return !ok() && status != SolveStatus::not_converged; }

  /// Makes this the report of a task with one part more: iterations are summed, the residual is the
  /// largest, status and message are those of the last part that was not ok, if any. A cap met in
  /// an earlier part is not hidden by a later one that is ok.
  void add(SolveReport part);
};

}  // namespace pleat
