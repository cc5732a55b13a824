#include "core/sweep/work_estimate.h"

#include <catch2/catch.hpp>
#include <vector>

using namespace pleat;

TEST_CASE("work_estimate: nothing is expected from nothing", "[sweep]") {
  const std::vector<ExpectedWork> works = {{"a", 3, 1}, {"b", 5, 2}};
  CHECK_FALSE(expected_rest(works));
  CHECK(passed_share(works) == 0);
}

TEST_CASE("work_estimate: what is known of a work is its rest", "[sweep]") {
  const std::vector<ExpectedWork> works = {{"a", 3, 1, 0.25, 8.0}, {"b", 5, 4, 1, 2.0}};
  CHECK(*expected_rest(works) == Approx(0.75 * 8 + 3 * 2));
  CHECK(passed_share(works) == Approx((0.25 * 3 + 5) / (3 + 20)));
}

TEST_CASE("work_estimate: work takes as long as the nearest of its kind", "[sweep]") {
  const std::vector<ExpectedWork> works = {
      {"a", 1, 1, 1, 10.0}, {"a", 4, 1, 1, 20.0}, {"b", 4, 1, 1, 1.0}, {"a", 16, 3}};
  CHECK(*expected_rest(works) == Approx(3 * 16 * 20.0 / 4));
}

TEST_CASE("work_estimate: of an unknown kind it takes as long as all that is known", "[sweep]") {
  const std::vector<ExpectedWork> works = {{"a", 1, 1, 1, 10.0}, {"b", 4, 1, 1, 20.0}, {"c", 6, 2}};
  CHECK(*expected_rest(works) == Approx(2 * 6 * 30.0 / 5));
}

TEST_CASE("work_estimate: all that is done has no rest", "[sweep]") {
  const std::vector<ExpectedWork> works = {{"a", 1, 2, 2, 10.0}, {"b", 4, 1, 1, 20.0}};
  CHECK(*expected_rest(works) == 0);
  CHECK(passed_share(works) == 1);
}
