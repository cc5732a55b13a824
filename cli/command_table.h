#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/arguments.h"

namespace pleat {

/// How a command ended; bad input throws InputError instead.
enum class Outcome {
  ok,
  check_failed,  ///< it ran, but something it looked at is not as it should be
};

struct Command;
/// Commands in the order in which help lists them.
using CommandTable = std::span<const Command* const>;

/// A command, or a part of one that stands after its name. Dispatch and help read nothing else.
struct Command {
  const char* name;
  const char* words;    ///< follow the name: "SCENE.json"
  const char* meaning;  ///< a phrase
  Outcome (*run)(Arguments arguments);
  std::array<const char*, 5> common;  ///< lines of help on options that others have too, or null
  const char* options;                ///< lines of help on its own
  CommandTable parts;                 ///< one of them is the first word

  constexpr Command(const char* its_name, const char* its_words, const char* its_meaning,
                    Outcome (*run_it)(Arguments), const std::array<const char*, 5>& in_common,
                    const char* its_options, CommandTable its_parts = {})
      : name(its_name),
        words(its_words),
        meaning(its_meaning),
        run(run_it),
        common(in_common),
        options(its_options),
        parts(its_parts) {}
};

constexpr const char* kJsonHelp = "  --json                 print for machines\n";

/// All that Pleat has.
CommandTable standard_commands();

/// Takes the first word, the name of a command of `of`, or of the first table. Throws InputError
/// that lists the names.
const Command& take_command(CommandTable table, Arguments& arguments, const std::string& of = "");

/// The help that is asked for: by no words, by "help" before a command's name or "--help" behind
/// it. Nothing where none is. Throws InputError for a name that the table lacks.
std::optional<std::string> asked_help(CommandTable table, const std::vector<std::string>& words);

/// Prints the help that is asked for, else runs the command that the first word names.
Outcome dispatch(CommandTable table, const std::vector<std::string>& words);

}  // namespace pleat
