#include "core/linalg/aggregation/aggregation.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>

namespace pleat {
namespace {

LowerPattern graph_of(int n_nodes, std::vector<std::array<int, 2>> edges) {
  LowerPattern graph;
  for (std::array<int, 2>& edge : edges)
    if (edge[0] < edge[1]) std::swap(edge[0], edge[1]);
  std::sort(edges.begin(), edges.end());
  for (int node = 0; node < n_nodes; ++node) {
    for (const auto& [row, column] : edges)
      if (row == node) graph.columns.push_back(column);
    graph.begins.push_back(static_cast<int>(graph.columns.size()));
  }
  graph.find_columns();
  return graph;
}

LowerPattern grid(int side) {
  std::vector<std::array<int, 2>> edges;
  for (int r = 0; r < side; ++r) {
    for (int c = 0; c < side; ++c) {
      if (c > 0) edges.push_back({r * side + c, r * side + c - 1});
      if (r > 0) edges.push_back({r * side + c, r * side + c - side});
    }
  }
  return graph_of(side * side, edges);
}

std::vector<int> sizes_of(const Aggregates& groups) {
  std::vector<int> sizes(place(groups.count), 0);
  for (const int group : groups.of_node)
    if (group >= 0) ++sizes[place(group)];
  return sizes;
}

}  // namespace

TEST_CASE("linalg: a pattern knows the blocks of its columns", "[linalg]") {
  const LowerPattern graph = graph_of(4, {{0, 2}, {0, 3}, {1, 3}});
  CHECK(graph.column_begins == std::vector<int>{0, 2, 3, 3, 3});
  CHECK(graph.column_rows == std::vector<int>{2, 3, 3});
  CHECK(graph.column_blocks == std::vector<int>{0, 1, 2});
}

TEST_CASE("linalg: groups of a grid have between half and twice the size asked for", "[linalg]") {
  const int size = GENERATE(4, 10);
  const std::vector<int> sizes = sizes_of(aggregate(grid(20), size));
  CAPTURE(size);
  REQUIRE_FALSE(sizes.empty());
  CHECK(2 * *std::min_element(sizes.begin(), sizes.end()) >= size);
  CHECK(*std::max_element(sizes.begin(), sizes.end()) <= 2 * size);
}

TEST_CASE("linalg: every node of a group reaches the others inside it", "[linalg]") {
  const LowerPattern graph = grid(15);
  const Aggregates groups = aggregate(graph, 10);
  std::vector<int> reached(groups.of_node.size());
  for (std::size_t k = 0; k < reached.size(); ++k) reached[k] = static_cast<int>(k);
  for (std::size_t round = 0; round < reached.size(); ++round)
    for (int row = 0; row < graph.n_rows(); ++row)
      for (int k = graph.begins[place(row)]; k < graph.begins[place(row) + 1]; ++k) {
        const int column = graph.columns[place(k)];
        if (groups.of_node[place(row)] != groups.of_node[place(column)]) continue;
        const int least = std::min(reached[place(row)], reached[place(column)]);
        reached[place(row)] = reached[place(column)] = least;
      }
  std::sort(reached.begin(), reached.end());
  CHECK(std::unique(reached.begin(), reached.end()) - reached.begin() == groups.count);
}

TEST_CASE("linalg: a node without edges is in no group, and pieces share none", "[linalg]") {
  const Aggregates groups = aggregate(graph_of(6, {{0, 2}, {4, 5}}), 10);
  CHECK(groups.count == 2);
  CHECK(groups.of_node == std::vector<int>{0, -1, 0, -1, 1, 1});
}

}  // namespace pleat
