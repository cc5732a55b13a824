#include "core/multigrid/mesh_hierarchy.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/multigrid/edge_collapse.h"
#include "core/multigrid/surface_distances.h"

namespace pleat {
namespace {

using Neighbours = std::vector<std::vector<VertexId>>;

/// Triangles between vertices of the finest mesh, between those of the level.
void take_triangles(MeshLevel& level, const std::vector<Triangle>& triangles,
                    std::size_t n_finest) {
  std::vector<VertexId> number(n_finest);
  for (std::size_t i = 0; i < level.vertices.size(); ++i)
    number[level.vertices[i]] = VertexId(static_cast<std::int64_t>(i));
  for (const auto& [a, b, c] : triangles)
    level.triangles.push_back({number[a], number[b], number[c]});
}

/// On the finest level a path along the edge is the shortest, unless a seam says otherwise.
void measure_edges(MeshLevel& level, const TriangleMesh& finest, SurfaceDistances& surface) {
  const auto n = static_cast<std::size_t>(level.n_vertices());
  std::vector<std::vector<VertexId>> ends(n);  // of edges, at the lower number
  for (const MeshEdge& edge : mesh_edges(level.triangles)) {
    const auto [low, high] = std::minmax(edge.a, edge.b);
    ends[low].push_back(high);
  }
  for (std::size_t v = 0; v < n; ++v) {
    if (ends[v].empty()) continue;
    std::sort(ends[v].begin(), ends[v].end());
    std::vector<VertexId> in_finest;
    for (const VertexId end : ends[v]) in_finest.push_back(level.vertices[end]);
    const std::vector<double> geodesics = surface.to(level.vertices[v], in_finest);
    for (std::size_t k = 0; k < ends[v].size(); ++k) {
      const double chord =
          (finest.rest_positions.col(in_finest[k]) - finest.rest_positions.col(level.vertices[v]))
              .norm();
      level.edges.push_back(
          {VertexId(static_cast<std::int64_t>(v)), ends[v][k], geodesics[k], chord});
    }
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
    kept.push_back(VertexId(at - finer.vertices.begin()));
  }
  return kept;
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
  EdgeCollapse collapse(mesh, is_fixed);
  SurfaceDistances surface(mesh);
  MeshHierarchy hierarchy;
  const auto add_level = [&] {
    MeshLevel level;
    level.vertices = collapse.vertices();
    take_triangles(level, collapse.triangles(), static_cast<std::size_t>(mesh.n_vertices()));
    measure_edges(level, mesh, surface);
    hierarchy.levels.push_back(std::move(level));
  };
  add_level();
  for (int k = 0; k < options.n_coarser; ++k) {
    MeshLevel& finer = hierarchy.levels.back();
    const int n_wanted = static_cast<int>(std::lround(options.ratio * finer.n_vertices()));
    if (n_wanted == finer.n_vertices() || !collapse.reach(n_wanted)) {
      hierarchy.shortage = shortage_at(static_cast<int>(hierarchy.levels.size()), options.n_coarser,
                                       collapse.n_vertices(), n_wanted);
      break;
    }
    add_level();
    MeshLevel& above = hierarchy.levels[hierarchy.levels.size() - 2];
    above.from_coarser =
        transfer_between(kept_of(above, hierarchy.levels.back()), neighbours_on(above),
                         positions_on(above, mesh.rest_positions), options.weights);
  }
  return hierarchy;
}

}  // namespace pleat
