#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <vector>

#include "cli/command_table.h"
#include "cli/overwriting.h"
#include "cli/progress.h"
#include "cli/scene_input.h"
#include "core/base/core_version.h"
#include "core/dynamics/stepper_table.h"
#include "core/hard_cases/case_report.h"
#include "core/hard_cases/hard_case_table.h"

namespace pleat {
namespace {

constexpr const char* kUsualScenes = "assets/hard_cases";

/// The cases that words name, in the order of the table; all without words.
std::vector<HardCase> named_cases(Arguments& arguments) {
  std::vector<HardCase> cases = hard_cases();
  std::string known;
  for (const HardCase& hard_case : cases) known += (known.empty() ? "" : ", ") + hard_case.name;
  std::set<std::string> names;
  while (arguments.has_words()) {
    const std::string name = *names.insert(arguments.word("a case's name")).first;
    if (std::none_of(cases.begin(), cases.end(), [&](const HardCase& c) { return c.name == name; }))
      throw InputError(cut(name), "unknown case; the cases are " + known);
  }
  if (!names.empty())
    std::erase_if(cases, [&](const HardCase& c) { return names.count(c.name) == 0; });
  return cases;
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

std::vector<CaseOutcome> run_cases(const std::vector<HardCase>& cases,
                                   const std::vector<const StepperType*>& steppers,
                                   CaseLength length, const CaseFiles& files) {
  Progress progress;
  std::vector<CaseOutcome> outcomes;
  double n_all = 0;
  for (const HardCase& hard_case : cases)
    n_all += hard_case.still ? 1 : static_cast<double>(steppers.size());
  for (const HardCase& hard_case : cases) {
    if (hard_case.still) outcomes.push_back(do_case(hard_case, files));
    for (std::size_t s = 0; s < steppers.size() && !hard_case.still; ++s) {
      const auto n_done = static_cast<double>(outcomes.size());
      const std::string what = hard_case.name + ", " + steppers[s]->name;
      outcomes.push_back(run_case(hard_case, *steppers[s], length, files, [&](double share) {
        progress.show((n_done + share) / n_all, what);
      }));
    }
  }
  return outcomes;
}

Outcome hard_cases_command(Arguments arguments) {
  std::string call = "./pleat hard-cases";
  for (const std::string& word : arguments.words()) call += " " + word;
  const bool is_short = arguments.flag("--short");
  Overwriting overwriting(arguments);
  const std::string folder = arguments.text("--scenes").value_or(kUsualScenes);
  const auto markdown = arguments.text("--markdown");
  const auto json = arguments.text("--json");
  const FabricLibrary fabrics = take_fabrics(arguments);
  const std::vector<const StepperType*> steppers = take_steppers(arguments);
  const std::vector<HardCase> cases = named_cases(arguments);
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
  std::string lines;
  for (const CaseOutcome& outcome : outcomes) {
    Json line = json_outcome(outcome);
    line["core"] = core_version();
    lines += line.dump() + "\n";
  }
  if (json) write_file(*json, lines);
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
