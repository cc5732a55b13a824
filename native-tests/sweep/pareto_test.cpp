#include "core/sweep/pareto.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/base/random.h"

using namespace pleat;

namespace {

using Indices = std::vector<std::size_t>;

bool beats(const CostAndError& a, const CostAndError& b) {
  return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
}

/// The front by its definition, in a time of the square of the number of points.
Indices front_by_definition(const std::vector<CostAndError>& points) {
  Indices front;
  for (std::size_t i = 0; i < points.size(); ++i) {
    bool stays = !std::isnan(points[i].cost) && !std::isnan(points[i].error);
    for (std::size_t j = 0; j < points.size(); ++j) {
      const bool equal_before =
          j < i && points[j].cost == points[i].cost && points[j].error == points[i].error;
      stays = stays && !beats(points[j], points[i]) && !equal_before;
    }
    if (stays) front.push_back(i);
  }
  return front;
}

}  // namespace

TEST_CASE("pareto: the front holds what nothing beats, from cheap to dear", "[sweep]") {
  const std::vector<CostAndError> points = {{4, 1}, {1, 4}, {2, 2}, {3, 3}, {5, 1}};
  CHECK(pareto_front(points) == Indices{1, 2, 0});
}

TEST_CASE("pareto: of equal points the first stands for all", "[sweep]") {
  const std::vector<CostAndError> points = {{2, 2}, {1, 3}, {2, 2}, {1, 3}};
  CHECK(pareto_front(points) == Indices{1, 0});
}

TEST_CASE("pareto: what could not be measured is not on the front", "[sweep]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<CostAndError> points = {{nan, 0}, {0, nan}, {nan, nan}, {7, 7}};
  CHECK(pareto_front(points) == Indices{3});
  CHECK(pareto_front({}).empty());
}

TEST_CASE("pareto: the front of random points is that of its definition", "[sweep]") {
  Random random(static_cast<std::uint64_t>(GENERATE(range(1, 21))));
  std::vector<CostAndError> points;
  const auto n = random.below(60);
  for (int i = 0; i < n; ++i) {  // whole numbers, so that ties occur
    points.push_back(
        {static_cast<double>(random.below(12)), static_cast<double>(random.below(12))});
    if (random.below(10) == 0) points.back().error = std::numeric_limits<double>::quiet_NaN();
  }
  Indices front = pareto_front(points);
  for (std::size_t k = 1; k < front.size(); ++k)
    CHECK(points[front[k - 1]].cost < points[front[k]].cost);
  std::sort(front.begin(), front.end());
  CHECK(front == front_by_definition(points));
}
