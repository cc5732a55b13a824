#include "core/hierarchy/mesh_hierarchy.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/hierarchy/edge_collapse.h"
#include "core/hierarchy/surface_distances.h"
#include "core/hierarchy/thinned_graph.h"

namespace pleat {
namespace {

/// Edges between vertices of a level, the lower number first, ascending.
using Pairs = std::vector<std::array<VertexId, 2>>;

Pairs pairs_of(const std::vector<Triangle>& triangles) {
  Pairs pairs;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k)
      pairs.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// Triangles between vertices of the finest mesh, between those of the level.
void take_triangles(MeshLevel& level, const std::vector<Triangle>& triangles,
                    std::size_t n_finest) {
  std::vector<VertexId> number(n_finest);
  for (std::size_t i = 0; i < level.vertices.size(); ++i)
    number[level.vertices[i]] = VertexId(static_cast<std::int64_t>(i));
  for (const auto& [a, b, c] : triangles)
    level.triangles.push_back({number[a], number[b], number[c]});
}

void take_edges(MeshLevel& level, const Pairs& pairs, const Positions& finest) {
  for (const auto& [a, b] : pairs) {
    const double chord = (finest.col(level.vertices[b]) - finest.col(level.vertices[a])).norm();
    level.edges.push_back({a, b, chord, chord});
  }
}

/// Measures the edges of all levels at once, as what is near a vertex is the same on each.
void measure_edges(std::vector<MeshLevel>& levels, const TriangleMesh& finest) {
  SurfaceDistances surface(finest);
  std::vector<std::size_t> measured(levels.size(), 0);
  std::vector<LevelEdge*> edges;
  std::vector<VertexId> ends;  // ends in the finest mesh
  for (int v = 0; v < finest.n_vertices(); ++v) {
    edges.clear();
    ends.clear();
    for (std::size_t k = 0; k < levels.size(); ++k) {
      MeshLevel& level = levels[k];
      for (std::size_t& next = measured[k]; next < level.edges.size(); ++next) {
        if (level.vertices[level.edges[next].a] != VertexId(v)) break;
        edges.push_back(&level.edges[next]);
        ends.push_back(level.vertices[level.edges[next].b]);
      }
    }
    if (ends.empty()) continue;
    const std::vector<double> geodesics = surface.to(VertexId(v), ends);
    for (std::size_t i = 0; i < edges.size(); ++i) edges[i]->geodesic = geodesics[i];
  }
}

Neighbours neighbours_on(const MeshLevel& level) {
  Neighbours neighbours(static_cast<std::size_t>(level.n_vertices()));
  for (const LevelEdge& edge : level.edges) {
    neighbours[edge.a].push_back(edge.b);
    neighbours[edge.b].push_back(edge.a);
  }
  return neighbours;
}

/// Numbers in `finer` of the vertices of `coarser`.
std::vector<VertexId> kept_of(const MeshLevel& finer, const MeshLevel& coarser) {
  std::vector<VertexId> kept;
  auto at = finer.vertices.begin();
  for (const VertexId v : coarser.vertices) {
    at = std::lower_bound(at, finer.vertices.end(), v);
    kept.emplace_back(at - finer.vertices.begin());
  }
  return kept;
}

/// The next level of thinned ones, with as many vertices if none may go.
MeshLevel thinned_level(const MeshLevel& finer, const TriangleMesh& mesh,
                        const std::vector<bool>& is_fixed) {
  std::vector<bool> stays;
  for (const VertexId v : finer.vertices) stays.push_back(!is_fixed.empty() && is_fixed[v]);
  const ThinnedGraph graph =
      thinned(neighbours_on(finer), positions_on(finer, mesh.rest_positions), stays);
  MeshLevel level;
  std::vector<VertexId> number(finer.vertices.size());
  for (std::size_t i = 0; i < graph.kept.size(); ++i) {
    number[graph.kept[i]] = VertexId(static_cast<std::int64_t>(i));
    level.vertices.push_back(finer.vertices[graph.kept[i]]);
  }
  Pairs pairs;
  for (const auto& [a, b] : graph.edges) pairs.push_back({number[a], number[b]});
  take_edges(level, pairs, mesh.rest_positions);
  return level;
}

std::string shortage_at(int n_levels, int asked, int n_reached, int n_wanted) {
  return "expected " + std::to_string(asked) + " coarser levels, got " +
         std::to_string(n_levels - 1) + ": the next keeps " + std::to_string(n_wanted) +
         " vertices, and no collapse is allowed below " + std::to_string(n_reached);
}

}  // namespace

void HierarchyOptions::validate() const {
  if (n_coarser < 1)
    throw InputError("levels", "expected 1 or more, got " + std::to_string(n_coarser));
  if (!(ratio > 0.1 && ratio < 0.9))
    throw InputError("ratio",
                     "expected a number above 0.1 and below 0.9, got " + std::to_string(ratio));
}

Positions positions_on(const MeshLevel& level, const Positions& finest) {
  Positions own(3, level.n_vertices());
  for (std::size_t i = 0; i < level.vertices.size(); ++i)
    own.col(static_cast<Eigen::Index>(i)) = finest.col(level.vertices[i]);
  return own;
}

MeshHierarchy mesh_hierarchy(const TriangleMesh& mesh, const std::vector<bool>& is_fixed,
                             const HierarchyOptions& options) {
  options.validate();
  EdgeCollapse collapse(mesh, is_fixed, options.guards);
  MeshHierarchy hierarchy;
  const auto add_collapsed = [&] {
    MeshLevel level;
    level.vertices = collapse.vertices();
    take_triangles(level, collapse.triangles(), static_cast<std::size_t>(mesh.n_vertices()));
    take_edges(level, pairs_of(level.triangles), mesh.rest_positions);
    hierarchy.levels.push_back(std::move(level));
  };
  add_collapsed();
  for (int k = 0; k < options.n_coarser; ++k) {
    const MeshLevel& finer = hierarchy.levels.back();
    const int n_finer = finer.n_vertices();
    int n_wanted = n_finer - 1, n_reached = n_finer;
    if (options.selection == LevelSelection::thinned) {
      MeshLevel level = thinned_level(finer, mesh, is_fixed);
      n_reached = level.n_vertices();
      if (n_reached < n_finer) hierarchy.levels.push_back(std::move(level));
    } else {
      n_wanted = static_cast<int>(std::lround(options.ratio * n_finer));
      const bool is_reached = n_wanted < n_finer && collapse.reach(n_wanted);
      n_reached = collapse.n_vertices();
      if (is_reached) add_collapsed();
    }
    if (hierarchy.levels.back().n_vertices() == n_finer) {
      hierarchy.shortage = shortage_at(static_cast<int>(hierarchy.levels.size()), options.n_coarser,
                                       n_reached, n_wanted);
      break;
    }
    MeshLevel& above = hierarchy.levels[hierarchy.levels.size() - 2];
    above.from_coarser =
        transfer_between(kept_of(above, hierarchy.levels.back()), neighbours_on(above),
                         positions_on(above, mesh.rest_positions), options.weights);
  }
  measure_edges(hierarchy.levels, mesh);
  return hierarchy;
}

}  // namespace pleat
