#include "core/hard_cases/case_report.h"

#include <algorithm>
#include <vector>

#include "core/base/formatted.h"
#include "core/dynamics/stepper_table.h"

namespace pleat {
namespace {

constexpr const char* kWithoutStepper = "no stepper";

/// A cell may hold any text but these.
std::string escaped(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, 1, '\\');
  return text;
}

/// Sentences below a table, each told once, and their numbers from 1.
class Notes {
 public:
  /// " [3]", or nothing without a sentence.
  std::string mark(const std::string& sentence) {
    if (sentence.empty()) return "";
    const auto at = std::find(sentences_.begin(), sentences_.end(), sentence);
    const auto number = at - sentences_.begin() + 1;
    if (at == sentences_.end()) sentences_.push_back(sentence);
    return " [" + std::to_string(number) + "]";
  }
  std::string list() const {
    std::string text;
    for (std::size_t n = 0; n < sentences_.size(); ++n)
      text += std::to_string(n + 1) + ". " + sentences_[n] + "\n";
    return text;
  }

 private:
  std::vector<std::string> sentences_;
};

/// The settings and the checks that are other for the stepper, the latter with their reasons.
std::string peculiarities_of(const HardCase& hard_case, const std::string& stepper) {
  std::string text;
  for (const StepperSetting& setting : hard_case.settings)
    if (setting.stepper == stepper)
      text += (text.empty() ? "" : "; ") + stepper + " with " + setting.change.pointer + " = " +
              setting.change.value.dump();
  for (const CaseException& exception : hard_case.exceptions)
    if (exception.stepper == stepper)
      text += (text.empty() ? "" : "; ") + stepper + ", " + exception.check + " " +
              (exception.bound ? "<= " + three_digits(*exception.bound) : "not asked") + ": " +
              exception.reason;
  return text;
}

std::string cell(const HardCase& hard_case, const CaseOutcome& outcome, Notes& notes) {
  std::string text = name(outcome.status);
  if (!outcome.is_expected()) return "**" + text + "**" + notes.mark(outcome.sentence);
  if (outcome.status != CaseStatus::ok)
    return text + notes.mark(outcome.excuse + ": " + outcome.sentence);
  if (outcome.is_cut()) text += ", " + three_digits(outcome.reached) + " s";
  return text + notes.mark(peculiarities_of(hard_case, outcome.stepper));
}

/// Null where there is none.
const CaseOutcome* outcome_of(const HardCase& hard_case, const std::string& stepper,
                              std::span<const CaseOutcome> outcomes) {
  const auto at = std::find_if(outcomes.begin(), outcomes.end(), [&](const CaseOutcome& o) {
    return o.case_name == hard_case.name && o.stepper == stepper;
  });
  return at == outcomes.end() ? nullptr : &*at;
}

std::vector<std::string> columns() {
  std::vector<std::string> names;
  for (const StepperType* type : standard_steppers()) names.emplace_back(type->name);
  names.emplace_back("");
  return names;
}

std::string outcome_table(std::span<const HardCase> cases, std::span<const CaseOutcome> outcomes,
                          Notes& notes) {
  std::string text = "| case |";
  std::string rule = "|---|";
  for (const std::string& column : columns()) {
    text.append(" ").append(column.empty() ? kWithoutStepper : column).append(" |");
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (const HardCase& hard_case : cases) {
    text += "| " + hard_case.name + " |";
    for (const std::string& column : columns()) {
      const CaseOutcome* outcome = outcome_of(hard_case, column, outcomes);
      if (outcome != nullptr) text.append(" ").append(escaped(cell(hard_case, *outcome, notes)));
      text += " |";
    }
    text += "\n";
  }
  return text;
}

template <class Checks>
void add_asked(const Checks& checks, std::string& text) {
  for (const auto& check : checks)
    text += (text.empty() ? "" : "; ") + check.what + " <= " + three_digits(check.bound);
}

/// Checks of a case; its outcome tells those of a case without a stepper.
std::string asked_of(const HardCase& hard_case, const CaseOutcome* outcome) {
  if (hard_case.is_bad_input) return "a refusal that names what is wrong";
  std::string text;
  if (outcome != nullptr) add_asked(outcome->findings, text);
  add_asked(hard_case.checks, text);
  add_asked(hard_case.variant_checks, text);
  return text;
}

std::string lengths_of(const HardCase& hard_case) {
  return hard_case.still
             ? ""
             : three_digits(hard_case.seconds.brief) + ", " + three_digits(hard_case.seconds.full);
}

std::string case_list(std::span<const HardCase> cases, std::span<const CaseOutcome> outcomes) {
  std::string text = "| case | what breaks others | asked | short, full [s] |\n|---|---|---|---|\n";
  for (const HardCase& hard_case : cases)
    text += "| " + hard_case.name + " | " + escaped(hard_case.breaks) + " | " +
            escaped(asked_of(hard_case, outcome_of(hard_case, "", outcomes))) + " | " +
            lengths_of(hard_case) + " |\n";
  return text;
}

}  // namespace

std::string case_tables(std::span<const HardCase> cases, std::span<const CaseOutcome> outcomes) {
  Notes notes;
  std::string text = outcome_table(cases, outcomes, notes) + "\n";
  const std::string list = notes.list();
  if (!list.empty()) text += list + "\n";
  return text + case_list(cases, outcomes);
}

Json json_outcome(const CaseOutcome& outcome) {
  Json json;
  json["case"] = outcome.case_name;
  json["stepper"] = outcome.stepper.empty() ? Json() : Json(outcome.stepper);
  json["status"] = name(outcome.status);
  json["expected"] = outcome.is_expected();
  json["sentence"] = outcome.sentence;
  json["excuse"] = outcome.excuse;
  json["asked_s"] = outcome.asked;
  json["reached_s"] = outcome.reached;
  json["findings"] = Json::array();
  for (const CaseFinding& finding : outcome.findings)
    json["findings"].push_back({{"what", finding.what},
                                {"found", finding.found},
                                {"bound", finding.bound},
                                {"kept", finding.is_kept()},
                                {"detail", finding.detail}});
  return json;
}

}  // namespace pleat
