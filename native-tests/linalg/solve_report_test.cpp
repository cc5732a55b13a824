#include "core/linalg/solve_report.h"

#include <catch2/catch.hpp>

using namespace pleat;

namespace {

const SolveReport kOk{SolveStatus::ok, 3, 1e-4, ""};
const SolveReport kCapped{SolveStatus::not_converged, 10, 1e-2, "the cap was met"};
const SolveReport kLost{SolveStatus::not_finite, 1, 0, "vertex 4 is lost"};

SolveReport sum(const std::vector<SolveReport>& parts) {
  SolveReport all;
  for (const SolveReport& part : parts) all.add(part);
  return all;
}

}  // namespace

TEST_CASE("solve_report: iterations add up and the largest residual stays", "[linalg]") {
  const SolveReport all = sum({kOk, kCapped, kOk});
  CHECK(all.iterations == 16);
  CHECK(all.relative_residual == 1e-2);
}

TEST_CASE("solve_report: a part that is ok hides no earlier one that was not", "[linalg]") {
  const SolveReport all = sum({kOk, kCapped, kOk});
  CHECK(all.status == SolveStatus::not_converged);
  CHECK(all.message == "the cap was met");
}

TEST_CASE("solve_report: the last part that is not ok gives status and message", "[linalg]") {
  const SolveReport all = sum({kCapped, kOk, kLost});
  CHECK(all.status == SolveStatus::not_finite);
  CHECK(all.message == "vertex 4 is lost");
  CHECK(all.ends_run());
}

TEST_CASE("solve_report: parts that are ok are ok together", "[linalg]") {
  CHECK(sum({kOk, kOk}).ok());
  CHECK(sum({kOk, kOk}).message.empty());
}
