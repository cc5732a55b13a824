#pragma once

#include <span>
#include <vector>

#include "core/fabric/spring_lattice.h"
#include "core/mesh/quad_mesh.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// Two vertices whose distance tells how far cloth is stretched, whatever its elastic model.
struct GaugeEdge {
  VertexId a, b;
  double rest_length = 0;  ///< [m], positive
};

/// A sheet's mesh edges: along warp, then along weft.
std::vector<GaugeEdge> gauge_edges(const QuadMesh& mesh);

/// All edges of a triangle mesh that have a length.
std::vector<GaugeEdge> gauge_edges(const TriangleMesh& mesh);

/// Springs that have a length and are not there against shear.
std::vector<GaugeEdge> gauge_edges(std::span<const Spring> springs);

}  // namespace pleat
