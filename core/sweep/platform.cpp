#include "core/sweep/platform.h"

#ifndef __wasm__
#include <sys/resource.h>
#endif

namespace pleat {

#ifdef __wasm__

const char* build_target() { return "wasm"; }

std::optional<std::int64_t> process_peak_memory() {
  constexpr std::int64_t kPage = 65536;  // [bytes], fixed by WebAssembly
  return static_cast<std::int64_t>(__builtin_wasm_memory_size(0)) * kPage;
}

std::optional<double> process_processor_time() { return std::nullopt; }

#else

const char* build_target() { return "native"; }

std::optional<std::int64_t> process_peak_memory() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return std::nullopt;
  constexpr std::int64_t kKilobyte = 1024;  // Linux counts in these
  return usage.ru_maxrss * kKilobyte;
}

std::optional<double> process_processor_time() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return std::nullopt;
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

#endif

}  // namespace pleat
