#pragma once

#include "core/base/vec.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// A closed surface.
struct BoxSurface {
  Positions positions;  ///< [m]
  std::vector<Triangle> triangles;
};

/// A box about the origin, its faces cut into squares of two triangles each, wound outward.
///
/// sides  [m], positive
/// cells  squares along the shortest side; along the others as many as come nearest to squares
///
/// Throws InputError for sides that are not positive, for no cells, and for more than kMaxVertices.
BoxSurface box_surface(const Vec3& sides, int cells);

}  // namespace pleat
