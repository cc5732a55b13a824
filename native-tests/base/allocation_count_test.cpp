#include "native-tests/support/allocation_count.h"

#include <catch2/catch.hpp>
#include <memory>

namespace pleat {

TEST_CASE("tests: what is allocated is counted", "[base]") {
  if (!counts_allocations()) return;
  std::unique_ptr<int[]> memory;
  CHECK(allocations_in([&] { memory = std::make_unique<int[]>(1000); }) == 1);
  CHECK(allocations_in([&] { memory.reset(); }) == 0);
}

}  // namespace pleat
