#pragma once

#include <string>
#include <vector>

#include "core/hard_cases/hard_case.h"

namespace pleat {

enum class CaseStatus {
  ok,       ///< it ran and kept what was asked of it
  stopped,  ///< the numbers ended the run
  refused,  ///< it was refused as bad input, before it started
  failed,   ///< it ran and did not keep what was asked
};

inline constexpr const char* kCaseStatusNames[] = {"ok", "stopped", "refused", "failed"};

constexpr const char* name(CaseStatus status) {
  return kCaseStatusNames[static_cast<std::size_t>(status)];
}

/// Outcome of a case with one stepper.
struct CaseOutcome {
  std::string case_name;
  std::string stepper = {};  ///< empty where the case has none
  CaseStatus status = CaseStatus::ok;
  std::string sentence = {};  ///< cause of a stop or refusal, or the failed check; empty when ok
  std::string excuse = {};    ///< reason why that is as it should be; else empty
  double asked = 0;           ///< simulated time that the case has [s]
  double reached = 0;         ///< time that it was given, or came to [s]
  std::vector<CaseFinding> findings = {};

  /// Ok, or excused.
  bool is_expected() const { return status == CaseStatus::ok || !excuse.empty(); }
  /// Dearer than a case may be: it was run over the first part of its time.
  bool is_cut() const { return status == CaseStatus::ok && reached < asked; }
};

/// Told how far a run has come, in [0, 1]; may be empty.
using CaseProgress = std::function<void(double share)>;

/// Runs a case with one stepper of files.tables; what would cost more than a case may
/// (StepperType::substep_cost) is cut, to at least one step. Throws InputError for a scene's file
/// that is missing or no JSON.
CaseOutcome run_case(const HardCase& hard_case, const StepperType& type, CaseLength length,
                     const CaseFiles& files, const CaseProgress& progress = {});

/// Does a case that has no stepper (HardCase::still).
CaseOutcome do_case(const HardCase& hard_case, const CaseFiles& files);

}  // namespace pleat
