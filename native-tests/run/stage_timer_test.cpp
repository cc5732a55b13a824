#include "core/run/stage_timer.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"

using namespace pleat;

TEST_CASE("stage_timer: a part inside another is not counted twice", "[run]") {
  const Stopwatch watch;
  StageTimer timer;
  {
    const StageScope outer(&timer, Stage::solve);
    const StageScope inner(&timer, Stage::contact);
    while (watch.elapsed() < 1e-3) continue;
  }
  const double all = watch.elapsed();
  CHECK(timer.total(Stage::contact) > timer.total(Stage::solve));
  CHECK(timer.total(Stage::contact) + timer.total(Stage::solve) <= all);
  CHECK(timer.total(Stage::forces) == 0);
}

TEST_CASE("stage_timer: parts end in the order in which they began, the last first", "[run]") {
  StageTimer timer;
  CHECK_THROWS_AS(timer.end(Stage::solve), ContractError);
  timer.begin(Stage::solve);
  timer.begin(Stage::contact);
  CHECK_THROWS_AS(timer.end(Stage::solve), ContractError);
}

TEST_CASE("stage_timer: clearing forgets", "[run]") {
  StageTimer timer;
  timer.begin(Stage::solve);
  timer.end(Stage::solve);
  timer.clear();
  CHECK(timer.total(Stage::solve) == 0);
}
