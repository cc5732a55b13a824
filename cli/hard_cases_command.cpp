#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <vector>

#include "cli/command_table.h"
#include "cli/overwriting.h"
#include "cli/progress.h"
#include "cli/scene_input.h"
#include "core/base/check.h"
#include "core/base/core_version.h"
#include "core/dynamics/stepper_table.h"
#include "core/files/whole_file.h"
#include "core/hard_cases/case_report.h"
#include "core/hard_cases/hard_case_table.h"

namespace pleat {
namespace {

constexpr const char* kUsualScenes = "assets/hard_cases";

/// Those of these names, in the order of the table; all without names.
std::vector<HardCase> named_cases(Arguments& arguments) {
  std::vector<HardCase> all = hard_cases();
  std::vector<std::string> names;
  std::string known;
  for (const HardCase& hard_case : all) known += (known.empty() ? "" : ", ") + hard_case.name;
  while (arguments.has_words()) {
    names.push_back(arguments.word("a case's name"));
    const bool is_known = std::any_of(all.begin(), all.end(),
                                      [&](const HardCase& c) { return c.name == names.back(); });
    if (!is_known) throw InputError(cut(names.back()), "unknown case; the cases are " + known);
  }
  if (names.empty()) return all;
  std::vector<HardCase> chosen;
  for (const HardCase& hard_case : all)
    if (std::find(names.begin(), names.end(), hard_case.name) != names.end())
      chosen.push_back(hard_case);
  return chosen;
}

std::vector<const StepperType*> take_steppers(Arguments& arguments) {
  const StepperTable all = standard_steppers();
  const auto name = arguments.text("--stepper");
  if (!name) return {all.begin(), all.end()};
  const StepperType* type = find_stepper(all, *name);
  if (type == nullptr)
    throw InputError("--stepper",
                     "expected one of " + stepper_names(all) + ", got " + quotation(*name));
  return {type};
}

/// Outcomes to be had of the cases.
std::size_t count_outcomes(const std::vector<HardCase>& cases, std::size_t n_steppers) {
  std::size_t n = 0;
  for (const HardCase& hard_case : cases) n += hard_case.still ? 1 : n_steppers;
  return n;
}

std::vector<CaseOutcome> run_cases(const std::vector<HardCase>& cases,
                                   const std::vector<const StepperType*>& steppers,
                                   CaseLength length, const CaseFiles& files) {
  Progress progress;
  std::vector<CaseOutcome> outcomes;
  const auto n_all = static_cast<double>(count_outcomes(cases, steppers.size()));
  for (const HardCase& hard_case : cases) {
    if (hard_case.still) {
      outcomes.push_back(do_case(hard_case, files));
      continue;
    }
    for (const StepperType* type : steppers) {
      const auto n_done = static_cast<double>(outcomes.size());
      const std::string what = hard_case.name + ", " + type->name;
      outcomes.push_back(run_case(hard_case, *type, length, files, [&](double share) {
        progress.show((n_done + share) / n_all, what);
      }));
    }
  }
  return outcomes;
}

/// How the words of a call are written, for what it wrote.
std::string call_of(const std::vector<std::string>& words) {
  std::string call = "./pleat hard-cases";
  for (const std::string& word : words) call += " " + word;
  return call;
}

std::string json_lines(const std::vector<CaseOutcome>& outcomes) {
  std::string text;
  for (const CaseOutcome& outcome : outcomes) {
    Json json = json_outcome(outcome);
    json["core"] = core_version();
    text += json.dump() + "\n";
  }
  return text;
}

Outcome hard_cases_command(Arguments arguments) {
  const std::string call = call_of(arguments.words());
  const bool is_short = arguments.flag("--short");
  Overwriting overwriting(arguments);
  const std::string folder = arguments.text("--scenes").value_or(kUsualScenes);
  const auto markdown = arguments.text("--markdown");
  const auto json = arguments.text("--json");
  const FabricLibrary fabrics = take_fabrics(arguments);
  const std::vector<const StepperType*> steppers = take_steppers(arguments);
  const std::vector<HardCase> cases = named_cases(arguments);
  arguments.finish();
  overwriting.need(markdown || json, "--markdown or --json");
  for (const auto& file : {markdown, json})
    if (file) overwriting.check(*file);

  std::vector<std::filesystem::path> read;
  const CaseFiles files{fabrics, files_beside(folder + "/.", read)};
  const std::vector<CaseOutcome> outcomes =
      run_cases(cases, steppers, is_short ? CaseLength::brief : CaseLength::full, files);
  const std::string tables = case_tables(cases, outcomes);
  if (markdown)
    write_file(*markdown, "# What came of the hard cases\n\nThis file is what `" + call +
                              "` wrote.\n\n" + tables);
  if (json) write_file(*json, json_lines(outcomes));
  if (!markdown && !json) std::printf("%s\n", tables.c_str());
  const auto n_unexpected =
      std::count_if(outcomes.begin(), outcomes.end(),
                    [](const CaseOutcome& outcome) { return !outcome.is_expected(); });
  std::printf("%zu outcomes, %lld unexpected\n", outcomes.size(),
              static_cast<long long>(n_unexpected));
  return n_unexpected == 0 ? Outcome::ok : Outcome::check_failed;
}

}  // namespace

extern const Command kHardCasesCommand(
    "hard-cases", "[NAME ...]", "what breaks cloth systems, run with every stepper: ok, or why not",
    hard_cases_command, {kOverwriteHelp, "  Exit status 1 when something is unexpected.\n"},
    R"(  --stepper NAME         with this one alone
  --short                the lengths that are tests
  --scenes DIR           of the cases' scenes (default: assets/hard_cases)
  --fabrics FILE         read the fabrics from here
  --markdown FILE  --json FILE   write the tables, or each outcome on a line
)");

}  // namespace pleat
