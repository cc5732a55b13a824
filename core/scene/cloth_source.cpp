#include "core/scene/cloth_source.h"

#include "core/mesh/mesh_lines.h"

namespace pleat {

/// Each level puts a vertex on every edge and in every face; an edge becomes two, a face four with
/// four edges between.
std::int64_t QuadCloth::n_vertices(int level) const {
  const QuadMesh base = base_quads();
  std::int64_t n_vertices = base.n_vertices();
  auto n_faces = static_cast<std::int64_t>(base.faces().size());
  auto n_edges = static_cast<std::int64_t>(thread_edges(base).edges.size());
  for (; level > 0; --level) {
    n_vertices += n_edges + n_faces;
    n_edges = 2 * n_edges + 4 * n_faces;
    n_faces *= 4;
  }
  return n_vertices;
}

RestCloth QuadCloth::at_rest(int level) const {
  QuadMesh quads = base_quads();
  quads.refine_uniformly(level);
  return at_rest(std::move(quads));
}

RestCloth flat_rest_cloth(QuadMesh quads) {
  RestCloth cloth;
  cloth.mesh = quads.triangle_mesh();
  cloth.rest_coordinates = quads.rest_coordinates();
  cloth.start = cloth.mesh.rest_positions;
  cloth.start_velocities = Positions::Zero(3, cloth.start.cols());
  cloth.quads = std::move(quads);
  return cloth;
}

}  // namespace pleat
