#include "core/base/random.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace pleat {

TEST_CASE("random: the published sequence of SplitMix64 comes out", "[base]") {
  Random random(1234567);  // first values of the authors' reference implementation
  CHECK(random.next() == 6457827717110365317ULL);
  CHECK(random.next() == 3203168211198807973ULL);
  CHECK(random.next() == 9817491932198370423ULL);
}

TEST_CASE("random: uniform numbers fill their interval evenly", "[base]") {
  constexpr int kDraws = 100000;
  Random random(GENERATE(1, 2, 3));
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.uniform(-1, 3);
    REQUIRE(value >= -1);
    REQUIRE(value < 3);
    sum += value;
    squares += value * value;
  }
  // Mean 1 and variance 4/3; five standard errors of each.
  CHECK(std::abs(sum / kDraws - 1) < 5 * std::sqrt(4.0 / 3 / kDraws));
  CHECK(std::abs(squares / kDraws - 7.0 / 3) < 0.05);
}

TEST_CASE("random: below(n) reaches every number under n and no other", "[base]") {
  Random random(7);
  bool seen[5] = {};
  for (int i = 0; i < 200; ++i) {
    const std::int64_t k = random.below(5);
    REQUIRE(k >= 0);
    REQUIRE(k < 5);
    seen[k] = true;
  }
  for (const bool one : seen) CHECK(one);
}

}  // namespace pleat
