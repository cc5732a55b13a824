#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "cli/command_table.h"
#include "core/base/core_version.h"
#include "core/files/whole_file.h"

namespace pleat {
namespace {

constexpr int kExitCheckFailed = 1;
constexpr int kExitBadInput = 2;
constexpr int kExitOwnFault = 3;

int run(const std::vector<std::string>& words) {
  const bool asks_version = words == std::vector<std::string>{"--version"};
  if (asks_version) std::printf("pleat %s\n", core_version());
  const Outcome outcome = asks_version ? Outcome::ok : dispatch(standard_commands(), words);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    std::fputs("pleat: the output could not be written whole\n", stderr);
    return kExitCheckFailed;
  }
  return outcome == Outcome::ok ? 0 : kExitCheckFailed;
}

}  // namespace
}  // namespace pleat

int main(int argc, char** argv) {
#ifdef SIGXFSZ
  std::signal(SIGXFSZ, SIG_IGN);  // a limit of file sizes is then an output that is lost
#endif
  try {
    return pleat::run(std::vector<std::string>(argv + 1, argv + argc));
  } catch (const pleat::LostOutput& error) {
    std::fprintf(stderr, "pleat: %s\n", pleat::printable(error.what()).c_str());
    return pleat::kExitCheckFailed;
  } catch (const pleat::InputError& error) {
    std::fprintf(stderr, "pleat: %s\n", pleat::printable(error.what()).c_str());
    return pleat::kExitBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pleat: this is a fault of the program: %s\n", error.what());
    return pleat::kExitOwnFault;
  }
}
