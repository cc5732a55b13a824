#include "core/scene/gauge.h"

namespace pleat {
namespace {

/// The two opposite edges of a face along one thread direction, as places among its corners.
using OppositeEdges = std::array<std::array<int, 2>, 2>;

constexpr OppositeEdges kAlongWarp{{{0, 1}, {3, 2}}};
constexpr OppositeEdges kAlongWeft{{{0, 3}, {1, 2}}};

double distance(const Positions& positions, VertexId a, VertexId b) {
  return (positions.col(a) - positions.col(b)).norm();
}

/// Each edge once: in each thread direction one at most begins at a vertex.
void append_edges(const QuadMesh& mesh, const OppositeEdges& opposite,
                  std::vector<GaugeEdge>& edges) {
  std::vector<bool> begins_edge(static_cast<std::size_t>(mesh.n_vertices()), false);
  for (const QuadFace& face : mesh.faces()) {
    if (!face.active()) continue;
    for (const auto& [begin, end] : opposite) {
      const VertexId a = face.corners[begin];
      const VertexId b = face.corners[end];
      if (begins_edge[a]) continue;
      begins_edge[a] = true;
      edges.push_back({a, b, distance(mesh.rest_positions(), a, b)});
    }
  }
}

}  // namespace

std::vector<GaugeEdge> gauge_edges(const QuadMesh& mesh) {
  std::vector<GaugeEdge> edges;
  append_edges(mesh, kAlongWarp, edges);
  append_edges(mesh, kAlongWeft, edges);
  return edges;
}

std::vector<GaugeEdge> gauge_edges(const TriangleMesh& mesh) {
  std::vector<GaugeEdge> edges;
  for (const MeshEdge& edge : mesh_edges(mesh.triangles)) {
    const double length = distance(mesh.rest_positions, edge.a, edge.b);
    if (length > 0) edges.push_back({edge.a, edge.b, length});
  }
  return edges;
}

std::vector<GaugeEdge> gauge_edges(std::span<const Spring> springs) {
  std::vector<GaugeEdge> edges;
  for (const Spring& spring : springs)
    if (spring.kind != SpringKind::shear && spring.rest_length > 0)
      edges.push_back({spring.a, spring.b, spring.rest_length});
  return edges;
}

}  // namespace pleat
