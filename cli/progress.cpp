#include "cli/progress.h"

#include <unistd.h>

#include <cstdio>

#include "core/files/json_text.h"

namespace pleat {
namespace {

constexpr double kSilentStart = 0.5;       // [s]; what is shorter needs no progress
constexpr double kTerminalInterval = 0.1;  // [s]
constexpr double kLogInterval = 5;         // [s]

}  // namespace

Progress::Progress() : on_terminal_(isatty(STDERR_FILENO) != 0), next_(kSilentStart) {}

Progress::~Progress() {
  if (line_is_open_) std::fputs("\r\x1b[K", stderr);
}

void Progress::show(double share, const std::string& message) {
  const double now = watch_.elapsed();
  if (now < next_) return;
  next_ = now + (on_terminal_ ? kTerminalInterval : kLogInterval);
  std::fprintf(stderr, on_terminal_ ? "\r\x1b[K%3.0f %% %s" : "%3.0f %% %s\n", 100 * share,
               printable(message).c_str());
  std::fflush(stderr);
  line_is_open_ = on_terminal_;
}

void tell_warnings(std::span<const RunWarning> warnings, const std::string& of) {
  const std::string begin = of.empty() ? "" : printable(of) + ": ";
  for (const RunWarning& warning : warnings)
    std::fprintf(stderr, "pleat: warning: %s%s; %s\n", begin.c_str(), sentence(warning).c_str(),
                 advice(warning).c_str());
}

void print_early_end(std::int64_t n_steps, const SolveReport& report, const char* consequence) {
  std::fprintf(stderr, "pleat: stopped in step %lld: %s%s\n", static_cast<long long>(n_steps + 1),
               report.message.c_str(), consequence);
}

}  // namespace pleat
