#pragma once

#include <array>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// An edge that passes through a face.
struct SurfaceCrossing {
  std::array<VertexId, 2> edge;
  int face = 0;
  Vec3 place{0, 0, 0};  ///< [m]
};

/// Edges of one surface that pass through faces of another, by edges. What only touches to rounding
/// is no crossing.
std::vector<SurfaceCrossing> crossings(const PositionsView& edge_places,
                                       const std::vector<Triangle>& triangles_with_edges,
                                       const PositionsView& face_places,
                                       const std::vector<Triangle>& faces);

/// Edges of a surface that pass through faces of its own that have neither of their ends.
std::vector<SurfaceCrossing> own_crossings(const PositionsView& places,
                                           const std::vector<Triangle>& triangles);

}  // namespace pleat
