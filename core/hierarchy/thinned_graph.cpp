#include "core/hierarchy/thinned_graph.h"

#include <algorithm>

#include "core/base/check.h"

namespace pleat {

ThinnedGraph thinned(const Neighbours& neighbours, const Positions& positions,
                     const std::vector<bool>& is_fixed) {
  constexpr int kFewestParents = 2;
  const std::size_t n = neighbours.size();
  PLEAT_CHECK(static_cast<std::size_t>(positions.cols()) == n && is_fixed.size() == n,
              "a position and a flag for each vertex");
  std::vector<bool> is_out(n, false);
  std::vector<int> n_kept(n);  // number of kept neighbours of each vertex
  for (std::size_t v = 0; v < n; ++v) n_kept[v] = static_cast<int>(neighbours[v].size());
  const auto may_go = [&](std::size_t v) {
    return !is_fixed[v] && n_kept[v] >= kFewestParents &&
           std::none_of(neighbours[v].begin(), neighbours[v].end(), [&](VertexId other) {
             return is_out[other] && n_kept[other] <= kFewestParents;
           });
  };
  for (std::size_t v = 0; v < n; ++v) {
    if (!may_go(v)) continue;
    is_out[v] = true;
    for (const VertexId other : neighbours[v]) --n_kept[other];
  }

  ThinnedGraph graph;
  std::vector<VertexId> place(n);  // kept vertex for each one: itself, or its nearest parent
  for (std::size_t v = 0; v < n; ++v) {
    const VertexId vertex(static_cast<std::int64_t>(v));
    place[v] = vertex;
    if (!is_out[v]) {
      graph.kept.push_back(vertex);
      continue;
    }
    double least = -1;
    for (const VertexId other : neighbours[v]) {
      const double square = (positions.col(other) - positions.col(vertex)).squaredNorm();
      if (is_out[other] || (least >= 0 && square >= least)) continue;
      least = square;
      place[v] = other;
    }
  }
  for (std::size_t v = 0; v < n; ++v)
    for (const VertexId other : neighbours[v]) {
      const VertexId a = std::min(place[v], place[other]), b = std::max(place[v], place[other]);
      if (a != b) graph.edges.push_back({a, b});
    }
  std::sort(graph.edges.begin(), graph.edges.end());
  graph.edges.erase(std::unique(graph.edges.begin(), graph.edges.end()), graph.edges.end());
  return graph;
}

}  // namespace pleat
