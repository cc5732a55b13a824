#include "core/scene/gauge.h"

#include "core/mesh/mesh_lines.h"

namespace pleat {
namespace {

double distance(const Positions& positions, VertexId a, VertexId b) {
  return (positions.col(a) - positions.col(b)).norm();
}

}  // namespace

std::vector<GaugeEdge> gauge_edges(const QuadMesh& mesh) {
  std::vector<GaugeEdge> edges;
  for (const ThreadEdge& edge : thread_edges(mesh).edges)
    edges.push_back({edge.from, edge.to, edge.length});
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
