#include "native-tests/support/pleat_command.h"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

namespace pleat {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

Ending pleat_command(const ScratchFolder& folder, const std::vector<std::string>& words,
                     const std::string& before, const std::string& after) {
  std::string line = before + "'" PLEAT_COMMAND "'";
  for (const std::string& word : words) line += " '" + word + "'";
  line +=
      " >'" + (folder / "stdout").string() + "' 2>'" + (folder / "stderr").string() + "'" + after;
  const int status = std::system(line.c_str());
  return {WEXITSTATUS(status), text_of(folder / "stdout"), text_of(folder / "stderr")};
}

}  // namespace pleat
