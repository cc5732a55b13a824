#include "cli/run_warnings.h"

#include <cstdio>

#include "core/files/json_text.h"

namespace pleat {

void tell_warnings(std::span<const RunWarning> warnings, const std::string& of) {
  const std::string begin = of.empty() ? "" : printable(of) + ": ";
  for (const RunWarning& warning : warnings)
    std::fprintf(stderr, "pleat: warning: %s%s; %s\n", begin.c_str(), sentence(warning).c_str(),
                 advice(warning).c_str());
}

}  // namespace pleat
