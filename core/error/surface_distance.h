#pragma once

#include <span>

#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// How far two surfaces are from each other, whatever their meshes [m].
struct SurfaceError {
  double rms = 0;
  double percentile_95 = 0;  ///< distance that this share of both surfaces together does not exceed
  double largest = 0;        ///< largest over all points
};

/// Distances from points of each surface to the nearest point of the other, exact to rounding. Both
/// surfaces have the same weight. Each triangle is split into m^2 equal ones whose centroids are
/// the points, m the least at which none of them has more of its surface's area than a quarter of
/// the mean triangle of the finer mesh. Sides, and folds that lie on each other, are not seen.
///
/// triangles, positions  of each surface [m]; a triangle without area has no points, but can be
///                       nearest. Of a surface without area all triangles count alike.
///
/// Throws ContractError unless both have a triangle and all positions are finite.
/// Source: Aspert, Santa-Cruz & Ebrahimi, MESH: Measuring errors between surfaces using the
/// Hausdorff distance, ICME 2002.
SurfaceError surface_error(std::span<const Triangle> triangles_a, const PositionsView& positions_a,
                           std::span<const Triangle> triangles_b, const PositionsView& positions_b);

}  // namespace pleat
