#include "core/linalg/king_ordering.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <utility>
#include <vector>

#include "core/base/random.h"

namespace pleat {
namespace {

using Graph = std::vector<std::vector<int>>;

void join(Graph& graph, int a, int b) {
  graph[static_cast<std::size_t>(a)].push_back(b);
  graph[static_cast<std::size_t>(b)].push_back(a);
}

std::vector<int> shuffled(int n, Random& random) {
  std::vector<int> names;
  for (int k = 0; k < n; ++k) {
    names.push_back(k);
    std::swap(names.back(), names[static_cast<std::size_t>(random.below(k + 1))]);
  }
  return names;
}

/// Summed over the nodes: places back to the first neighbour.
int profile(const Graph& graph, const std::vector<int>& order) {
  std::vector<int> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    place[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
  int sum = 0;
  for (std::size_t a = 0; a < graph.size(); ++a) {
    int first = place[a];
    for (const int b : graph[a]) first = std::min(first, place[static_cast<std::size_t>(b)]);
    sum += place[a] - first;
  }
  return sum;
}

}  // namespace

TEST_CASE("linalg: a shuffled strip is put in order along its length", "[linalg]") {
  const int width = GENERATE(1, 2, 5);
  constexpr int kLength = 30;
  Random random(3);
  const std::vector<int> name = shuffled(kLength * width, random);
  Graph graph(name.size());
  for (int row = 0; row < kLength; ++row) {
    for (int column = 0; column < width; ++column) {
      const auto at = [&](int r, int c) { return name[static_cast<std::size_t>(r * width + c)]; };
      if (row > 0) join(graph, at(row, column), at(row - 1, column));
      if (column > 0) join(graph, at(row, column), at(row, column - 1));
    }
  }
  const std::vector<int> order = reverse_king_ordering(graph);
  CHECK(profile(graph, order) <= profile(graph, name));  // the profile of its rows
  std::vector<int> nodes = order;
  std::sort(nodes.begin(), nodes.end());
  for (std::size_t k = 0; k < nodes.size(); ++k) CHECK(nodes[k] == static_cast<int>(k));
}

TEST_CASE("linalg: an order holds every part of a graph", "[linalg]") {
  Graph graph(7);  // 0-4-2 and 5-1 apart, 3 and 6 alone
  join(graph, 0, 4);
  join(graph, 4, 2);
  join(graph, 5, 1);
  std::vector<int> order = reverse_king_ordering(graph);
  CHECK(profile(graph, order) == 3);
  std::sort(order.begin(), order.end());
  CHECK(order == std::vector<int>{0, 1, 2, 3, 4, 5, 6});
  CHECK(reverse_king_ordering({}).empty());
}

}  // namespace pleat
