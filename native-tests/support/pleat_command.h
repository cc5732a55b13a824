#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "native-tests/support/scratch_folder.h"

namespace pleat {

std::string text_of(const std::filesystem::path& path);
void write(const std::filesystem::path& path, const std::string& text);

/// How a call of the command ended and what it printed.
struct Ending {
  int status;
  std::string out;
  std::string error;
};

/// Runs the command with these words, `before` it and `after` it in the same shell.
Ending pleat_command(const ScratchFolder& folder, const std::vector<std::string>& words,
                     const std::string& before = "", const std::string& after = "");

}  // namespace pleat
