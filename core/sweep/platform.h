#pragma once

#include <cstdint>
#include <optional>

namespace pleat {

/// "native" or "wasm".
const char* build_target();

/// The most memory that this process has held at once so far [bytes]; in WebAssembly its linear
/// memory, which only grows. Nothing where the platform does not tell.
std::optional<std::int64_t> process_peak_memory();

/// Processor time of all threads of this process so far [s], without the time during which other
/// programs ran. Nothing where the platform does not tell.
std::optional<double> process_processor_time();

}  // namespace pleat
