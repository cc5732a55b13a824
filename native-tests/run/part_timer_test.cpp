#include "core/run/part_timer.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"

using namespace pleat;

TEST_CASE("part_timer: a part inside another is not counted twice", "[run]") {
  const Stopwatch watch;
  PartTimer timer;
  {
    const PartScope outer(&timer, Part::solve);
    const PartScope inner(&timer, Part::contact);
    while (watch.elapsed() < 1e-3) continue;
  }
  const double all = watch.elapsed();
  CHECK(timer.total(Part::contact) > timer.total(Part::solve));
  CHECK(timer.total(Part::contact) + timer.total(Part::solve) <= all);
  CHECK(timer.total(Part::forces) == 0);
}

TEST_CASE("part_timer: parts end in the order in which they began, the last first", "[run]") {
  PartTimer timer;
  CHECK_THROWS_AS(timer.end(Part::solve), ContractError);
  timer.begin(Part::solve);
  timer.begin(Part::contact);
  CHECK_THROWS_AS(timer.end(Part::solve), ContractError);
}

TEST_CASE("part_timer: clearing forgets", "[run]") {
  PartTimer timer;
  timer.begin(Part::solve);
  timer.end(Part::solve);
  timer.clear();
  CHECK(timer.total(Part::solve) == 0);
}
