#pragma once

#include <vector>

#include "core/base/motion.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// A closed surface that cloth does not enter: a solid that is met by its own vertices, edges and
/// faces.
struct BodySurface {
  Positions places;  ///< places of its vertices at time 0 [m]
  std::vector<Triangle>
      triangles;  ///< vertices of each, wound counterclockwise as seen from outside
  Motion motion;
  double friction = 0.3;  ///< Coulomb coefficient against the cloth, not below 0

  int n_vertices() const { return static_cast<int>(places.cols()); }
};

/// Surface of a box, of two triangles a side.
///
/// size  along x, y, and across both [m], positive
/// x, y  unit, perpendicular
BodySurface box_body(const Vec3& centre, const Vec3& size, const Vec3& x, const Vec3& y);

/// Volume that a closed surface holds [m^3]; negative where it is wound the other way.
double enclosed_volume(const PositionsView& places, const std::vector<Triangle>& triangles);

}  // namespace pleat
