#pragma once

#include <cstdint>

namespace pleat {

/// False under AddressSanitizer, which has a malloc of its own, and where the C library is not
/// glibc: a warning then tells that the test was skipped.
bool counts_allocations();

/// Calls of malloc, calloc, realloc and aligned_alloc by this program and its libraries so far;
/// operator new ends there.
std::int64_t allocations_so_far();

template <class Work>
std::int64_t allocations_in(Work&& work) {
  const std::int64_t before = allocations_so_far();
  work();
  return allocations_so_far() - before;
}

}  // namespace pleat
