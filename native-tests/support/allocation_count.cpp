#include "native-tests/support/allocation_count.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdlib>

#if defined(PLEAT_SANITIZED) || !defined(__GLIBC__)
#define PLEAT_OTHER_MALLOC
#endif

namespace {

std::atomic<std::int64_t> n_allocations{0};

}  // namespace

// A program's own malloc takes the place of the C library's, for the shared libraries too; what it
// returns may be given to the C library's free.
#ifndef PLEAT_OTHER_MALLOC
// NOLINTBEGIN: the names and parameters are the C library's.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  n_allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
  n_allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_calloc(count, size);
}

void* realloc(void* memory, std::size_t size) {
  n_allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_realloc(memory, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  n_allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_memalign(alignment, size);
}
}
// NOLINTEND
#endif

namespace pleat {

bool counts_allocations() {
#ifdef PLEAT_OTHER_MALLOC
  WARN("skipped: allocations are not counted beside another malloc");
  return false;
#else
  return true;
#endif
}

std::int64_t allocations_so_far() { return n_allocations.load(std::memory_order_relaxed); }

}  // namespace pleat
