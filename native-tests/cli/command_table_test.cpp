// The table of commands, and a made-up command that is added to it and named nowhere else.
#include "cli/command_table.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cctype>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "core/base/check.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/places.h"
#include "native-tests/support/small_scene.h"

namespace pleat {
namespace {

using Call = std::vector<std::string>;

/// Lists the words that name each command and each part of one.
std::vector<Call> all_calls() {
  std::vector<Call> calls;
  for (const Command* command : standard_commands()) {
    calls.push_back({command->name});
    for (const Command* part : command->parts) calls.push_back({command->name, part->name});
  }
  return calls;
}

Call with(Call words, const Call& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::string help_of(const Call& call) {
  return asked_help(standard_commands(), with({"help"}, call)).value();
}

/// Tells how a call of bad input is refused: the place and the sentence.
std::string refusal(CommandTable table, const Call& words) {
  try {
    dispatch(table, words);
  } catch (const InputError& error) {
    return error.where() + ": " + error.sentence();
  }
  return "taken";
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The constant that a command is, by its name: kHardCasesCommand of hard-cases.
std::string constant_of(const std::string& name) {
  std::string constant = "k";
  bool begins = true;
  for (const char letter : name) {
    if (letter != '-') constant += begins ? static_cast<char>(std::toupper(letter)) : letter;
    begins = letter == '-';
  }
  return constant + "Command";
}

Outcome run_made_up(Arguments arguments) {
  const bool fails = arguments.flag("--fail");
  arguments.finish();
  return fails ? Outcome::check_failed : Outcome::ok;
}

const Command kMadeUp("made-up", "[--fail]", "does nothing", run_made_up, {kJsonHelp},
                      "  --fail                 fail\n");
const Command* const kTable[] = {standard_commands()[0], &kMadeUp};

}  // namespace

TEST_CASE("command table: an added command is listed, found, run and helped with", "[cli]") {
  const std::string page = asked_help(kTable, {}).value();
  CHECK(says(page, "\n  made-up [--fail]  does nothing\n"));
  CHECK(says(page, "\n  run SCENE.json    compute a scene\n"));
  CHECK(asked_help(kTable, {"help"}) == page);
  const std::string help =
      "pleat made-up [--fail]    does nothing\n"
      "  --fail                 fail\n"
      "  --json                 print for machines\n";
  CHECK(asked_help(kTable, {"made-up", "--help"}) == help);
  CHECK(asked_help(kTable, {"made-up", "--fail", "-h"}) == help);
  CHECK(asked_help(kTable, {"help", "made-up"}) == help);
  CHECK_FALSE(asked_help(kTable, {"made-up"}));
  CHECK(dispatch(kTable, {"made-up"}) == Outcome::ok);
  CHECK(dispatch(kTable, {"made-up", "--fail"}) == Outcome::check_failed);
  CHECK(refusal(kTable, {"made-up", "--fails"}) ==
        "--fails: unknown option; the nearest is --fail");
  CHECK(refusal(kTable, {"made"}) == ": expected run, made-up or help after it, got \"made\"");
}

TEST_CASE("command table: an added part of a command is found and helped with", "[cli]") {
  const Command* const parts[] = {&kMadeUp};
  const Command whole("whole", "PART", "has parts", run_made_up, {}, "  more\n", parts);
  const Command* const table[] = {&whole};
  const std::string help = asked_help(table, {"whole", "made-up", "--help"}).value();
  CHECK(says(help, "pleat whole made-up [--fail]    does nothing\n  --fail "));
  CHECK(asked_help(table, {"help", "whole", "made-up"}) == help);
  CHECK(asked_help(table, {"whole", "--help"}) ==
        "pleat whole PART    has parts\n  made-up [--fail]  does nothing\n  more\n");
  Arguments arguments({"made", "up"});
  CHECK_THROWS_WITH(take_command(parts, arguments, "whole"),
                    "whole: expected made-up after it, got \"made\"");
}

TEST_CASE("command table: every command has help of its own, and all of them fit on one screen",
          "[cli]") {
  const std::string page = asked_help(standard_commands(), {}).value();
  CHECK(n_lines(page) <= 40);
  std::set<std::string> helps{page};
  for (const Call& call : all_calls()) {
    CAPTURE(call);
    const std::string help = help_of(call);
    CHECK(asked_help(standard_commands(), with(call, {"scene.json", "--help"})) == help);
    CHECK(helps.insert(help).second);
    CHECK(n_lines(help) >= (call[0] == "bench" ? 1 : 2));
    CHECK(says(call.size() == 1 ? page : help_of({call[0]}), "\n  " + call.back() + " "));
  }
  for (const std::string& help : helps)
    CHECK_FALSE(std::regex_search(help, std::regex("[^\n]{101}|^\n|  $|  \n")));
  CHECK(says(help_of({"steppers"}), "multigrid "));
  CHECK(refusal(standard_commands(), {"help", "frob"}) ==
        refusal(standard_commands(), {"frob", "--help"}));
  CHECK(says(refusal(standard_commands(), {"help", "run", "sweep"}), "sweep: one word too many"));
}

TEST_CASE("command table: one more is named in two places, its file and the table", "[cli]") {
  const std::set<std::string> own = {"run", "bench"};  // ./pleat shows one and adds to the other
  std::size_t most = 0;
  for (const Command* command : standard_commands()) {
    const std::string name = command->name;
    CAPTURE(name);
    std::string file = "cli/" + name + "_command";
    std::replace(file.begin(), file.end(), '-', '_');
    const std::set<std::string> named = files_naming({constant_of(name)});
    CHECK(named == std::set<std::string>{"cli/command_table", file});
    CHECK((own.count(name) == 1 || !says(repository_file("pleat"), name)));
    most = std::max(most, named.size());
  }
  tell_places("subcommand", most);
}

TEST_CASE("command table: commands take the options that their help names", "[cli]") {
  const std::regex option("--[a-z][a-z-]*");
  for (const Call& call : all_calls()) {
    const std::string help = help_of(call);
    std::set<std::string> names(std::sregex_token_iterator(help.begin(), help.end(), option), {});
    names.erase("--help");
    for (const std::string& name : names) {
      // Given twice, an option that is known is refused before anything is read.
      const auto refused = [&](const char* file) {
        return refusal(standard_commands(), with(call, {name, name, file}));
      };
      CAPTURE(call, name, refused("x.json"), refused("x.obj"));
      const auto is_known = [&](const std::string& sentence) {
        return sentence.rfind(name + ": expected ", 0) == 0;
      };
      CHECK((is_known(refused("x.json")) || is_known(refused("x.obj"))));
    }
  }
}

}  // namespace pleat
