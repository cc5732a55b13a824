#include "cli/command_table.h"

#include <algorithm>
#include <cstdio>

#include "core/base/check.h"
#include "core/dynamics/stepper_table.h"
#include "core/files/json_text.h"

namespace pleat {

extern const Command kRunCommand, kSweepCommand, kReferenceCommand, kRefineCommand, kDeformCommand,
    kModesCommand, kInbetweenCommand, kHierarchyCommand, kConvergenceCommand, kHardCasesCommand,
    kBenchCommand;

namespace {

constexpr const Command* kCommands[] = {
    &kRunCommand,         &kSweepCommand,     &kReferenceCommand, &kRefineCommand,
    &kDeformCommand,      &kModesCommand,     &kInbetweenCommand, &kHierarchyCommand,
    &kConvergenceCommand, &kHardCasesCommand, &kBenchCommand};

constexpr const char* kMoreHelp = R"(
pleat COMMAND --help, or pleat help COMMAND: its options, which may stand as --step S or --step=S
pleat help steppers: the steppers and the settings that they read
pleat --version
Exit status: 0 done, 1 ran but a check failed or the output was lost, 2 bad input, 3 a fault of the
program.
)";

bool is_help_option(const std::string& word) { return word == "--help" || word == "-h"; }

const Command* find_command(CommandTable table, const std::string& name) {
  const auto found = std::find_if(table.begin(), table.end(),
                                  [&](const Command* command) { return command->name == name; });
  return found == table.end() ? nullptr : *found;
}

/// A line for each command, their meanings in one column.
std::string lines_of(CommandTable table) {
  std::size_t width = 0;
  std::vector<std::string> calls;
  for (const Command* command : table) {
    calls.push_back(std::string("  ") + command->name + " " + command->words + "  ");
    width = std::max(width, calls.back().size());
  }
  std::string text;
  for (std::size_t k = 0; k < table.size(); ++k) {
    calls[k].resize(width, ' ');
    text += calls[k] + table[k]->meaning + "\n";
  }
  return text;
}

/// Help on a command, or on the part of it that the next word names.
std::string help_of(const Command& command, const std::string& before, Arguments& names) {
  const std::string call = before + " " + command.name;
  const Command* part =
      names.has_words() ? find_command(command.parts, names.words().front()) : nullptr;
  if (part != nullptr) return help_of(take_command(command.parts, names), call, names);
  std::string text = call + " " + command.words + "    " + command.meaning + "\n" +
                     lines_of(command.parts) + command.options;
  for (const char* lines : command.common)
    if (lines != nullptr) text += lines;
  return text;
}

}  // namespace

CommandTable standard_commands() { return kCommands; }

const Command& take_command(CommandTable table, Arguments& arguments, const std::string& of) {
  const std::string word = arguments.has_words() ? arguments.words().front() : "";
  if (const Command* command = find_command(table, word)) {
    arguments.first_word(command->name);
    return *command;
  }
  std::vector<const char*> names;
  for (const Command* command : table) names.push_back(command->name);
  if (of.empty()) names.push_back("help");
  throw InputError(of, "expected " + either(names) + " after it, got " +
                           (word.empty() ? "nothing" : quotation(word)));
}

std::optional<std::string> asked_help(CommandTable table, const std::vector<std::string>& words) {
  const bool is_first = words.empty() || words[0] == "help" || is_help_option(words[0]);
  if (!is_first && std::none_of(words.begin(), words.end(), is_help_option)) return std::nullopt;
  const std::ptrdiff_t n_before = is_first && !words.empty() ? 1 : 0;
  Arguments names({words.begin() + n_before, words.end()});
  if (!names.has_words())
    return "pleat COMMAND ...    cloth, computed and measured\n" + lines_of(table) + kMoreHelp;
  if (is_first && names.words().front() == "steppers") return stepper_help(standard_steppers());
  std::string text = help_of(take_command(table, names), "pleat", names);
  if (is_first) names.finish();
  return text;
}

Outcome dispatch(CommandTable table, const std::vector<std::string>& words) {
  if (const auto help = asked_help(table, words)) {
    std::fputs(help->c_str(), stdout);
    return Outcome::ok;
  }
  Arguments arguments(words);
  const Command& command = take_command(table, arguments);
  return command.run(std::move(arguments));
}

}  // namespace pleat
