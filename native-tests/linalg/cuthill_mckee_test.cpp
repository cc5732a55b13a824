#include "core/linalg/cuthill_mckee.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>

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

int bandwidth(const Graph& graph, const std::vector<int>& order) {
  std::vector<int> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    place[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
  int largest = 0;
  for (std::size_t a = 0; a < graph.size(); ++a)
    for (const int b : graph[a])
      largest = std::max(largest, std::abs(place[a] - place[static_cast<std::size_t>(b)]));
  return largest;
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
  const std::vector<int> order = reverse_cuthill_mckee(graph);
  CHECK(bandwidth(graph, order) <= width + 1);  // no order has less than the width
  std::vector<int> nodes = order;
  std::sort(nodes.begin(), nodes.end());
  for (std::size_t k = 0; k < nodes.size(); ++k) CHECK(nodes[k] == static_cast<int>(k));
}

TEST_CASE("linalg: an order holds every part of a graph", "[linalg]") {
  Graph graph(7);  // 0-4-2 and 5-1 apart, 3 and 6 alone
  join(graph, 0, 4);
  join(graph, 4, 2);
  join(graph, 5, 1);
  std::vector<int> order = reverse_cuthill_mckee(graph);
  CHECK(bandwidth(graph, order) == 1);
  std::sort(order.begin(), order.end());
  CHECK(order == std::vector<int>{0, 1, 2, 3, 4, 5, 6});
  CHECK(reverse_cuthill_mckee({}).empty());
}

}  // namespace pleat
