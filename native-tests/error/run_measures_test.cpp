#include "core/error/run_measures.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"

using namespace pleat;

namespace {

RunRecord timed(const std::vector<double>& frame_ms) { return {frame_ms, frame_ms, {0}, {0}, {}}; }

const Eigen::VectorXd kOne = Eigen::VectorXd::Ones(1);
const std::vector<Positions> kStill(2, Positions::Zero(3, 1));

}  // namespace

TEST_CASE("run_figures: time is the median of the runs' medians, with their spread", "[error]") {
  const std::vector<RunRecord> runs = {timed({30, 40, 500}), timed({20}), timed({60, 60})};
  const RunMeasures measures = run_measures(runs, {}, kOne);
  CHECK(measures.ms_per_frame == 40);
  CHECK(measures.spread_ms == 40);
  CHECK(std::isnan(run_measures(std::vector<RunRecord>{timed({})}, {}, kOne).ms_per_frame));
}

TEST_CASE("run_figures: stretch is of the frames of the first run", "[error]") {
  const std::vector<RunRecord> runs = {{{1}, {1}, {0.1, 0.4, 0.1}, {0.3, 0.6, 0.6}, {}},
                                       {{1}, {1}, {9}, {9}, {}}};
  const RunMeasures measures = run_measures(runs, {}, kOne);
  CHECK(measures.rms_stretch == Approx(0.2));
  CHECK(measures.largest_stretch == Approx(0.5));
  CHECK(measures.rms_stretch_worst_frame == 0.4);
}

TEST_CASE("run_figures: a time that the run did not reach has no error", "[error]") {
  RunRecord run = timed({1});
  run.samples = {Vec3(0, 3, 4)};
  const RunMeasures measures = run_measures(std::vector<RunRecord>{run}, kStill, kOne);
  REQUIRE(measures.position_errors.size() == 2);
  CHECK(measures.position_errors[0] == 5);
  CHECK(std::isnan(measures.position_errors[1]));
}

// The machine halves its speed after the second turn, and a frame and a turn are interrupted.
TEST_CASE("run_figures: ratios are of turns beside each other", "[error]") {
  const std::vector<RunRecord> slow = {timed({6, 6, 6, 6, 6, 6, 12, 12, 900}), timed({6, 6, 6})};
  const std::vector<RunRecord> quick = {timed({2, 2, 2, 2, 70, 2, 4, 4, 4}), timed({90, 90, 90})};
  CHECK(time_ratio(slow, quick, 3) == 3);
  CHECK(time_ratio(quick, slow, 3) == Approx(1.0 / 3));
  CHECK(std::isnan(time_ratio(slow, std::vector<RunRecord>{timed({})}, 3)));
  RunRecord waiting = timed({2, 2, 2});
  waiting.frame_ms = {40, 20, 30};
  CHECK(time_ratio(std::vector<RunRecord>{waiting}, quick, 3) == 1);
  CHECK_THROWS_AS(time_ratio(slow, quick, 0), ContractError);
}
