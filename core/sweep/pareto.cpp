#include "core/sweep/pareto.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace pleat {

std::vector<std::size_t> pareto_front(std::span<const CostAndError> points) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!std::isnan(points[i].cost) && !std::isnan(points[i].error)) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(points[a].cost, points[a].error, a) <
           std::tie(points[b].cost, points[b].error, b);
  });
  // Cheapest first: a point is on the front when it is less wrong than every cheaper one.
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || points[i].error < points[front.back()].error) front.push_back(i);
  return front;
}

}  // namespace pleat
