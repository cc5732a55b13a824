#include "native-tests/support/topology.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace pleat {
namespace {

using Edge = std::pair<int, int>;

/// True when a vertex's opposite edges, put end to end, are one line or one ring.
bool is_one_fan(const std::map<int, int>& opposite_edges) {
  if (opposite_edges.empty()) return false;
  std::set<int> ends;
  for (const auto& [from, to] : opposite_edges) ends.insert(to);
  int at = opposite_edges.begin()->first;
  for (const auto& [from, to] : opposite_edges)
    if (ends.count(from) == 0) at = from;
  std::size_t n_walked = 0;
  for (auto edge = opposite_edges.find(at);
       edge != opposite_edges.end() && n_walked < opposite_edges.size();
       edge = opposite_edges.find(edge->second))
    ++n_walked;
  return n_walked == opposite_edges.size();
}

int n_cycles(std::map<int, int> next) {
  int n = 0;
  for (; !next.empty(); ++n)
    for (auto at = next.begin(); at != next.end();) {
      const int to = at->second;
      next.erase(at);
      at = next.find(to);
    }
  return n;
}

int n_components(const std::vector<Triangle>& triangles, int n_vertices) {
  std::vector<int> part(static_cast<std::size_t>(n_vertices));
  for (int i = 0; i < n_vertices; ++i) part[static_cast<std::size_t>(i)] = i;
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (const Triangle& t : triangles) {
      const int least = std::min({part[t[0]], part[t[1]], part[t[2]]});
      for (const VertexId v : t) {
        has_changed = has_changed || part[v] != least;
        part[v] = least;
      }
    }
  }
  return static_cast<int>(std::set<int>(part.begin(), part.end()).size());
}

}  // namespace

Topology topology(const std::vector<Triangle>& triangles, int n_vertices) {
  Topology result;
  std::set<Edge> directed;
  std::vector<std::map<int, int>> opposite(static_cast<std::size_t>(n_vertices));
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b, c] = std::array{t[k], t[(k + 1) % 3], t[(k + 2) % 3]};
      const bool is_first = directed.insert({a, b}).second && opposite[a].emplace(b, c).second;
      result.is_manifold = result.is_manifold && is_first;
    }
  int n_edges = 0;
  std::map<int, int> border;
  for (const auto& [from, to] : directed) {
    const bool is_border = directed.count({to, from}) == 0;
    if (is_border || from < to) ++n_edges;
    if (is_border) border.emplace(from, to);
  }
  for (const auto& edges : opposite) result.is_manifold = result.is_manifold && is_one_fan(edges);
  result.n_components = n_components(triangles, n_vertices);
  result.n_border_loops = n_cycles(std::move(border));
  result.euler = n_vertices - n_edges + static_cast<int>(triangles.size());
  return result;
}

}  // namespace pleat
