#pragma once

#include "core/linalg/sparse.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// The Hessian, at rest and with rotations differentiated, of the as-rigid-as-possible energy of a
/// surface alone:
///
///     E(x) = sum_v min_R sum_j w_vj |(x_j - x_v) - R (p_j - p_v)|^2      [J for w in N/m]
///
/// with the cotangent weights w (negative ones count as none) of the edges around each vertex, all
/// times `stiffness` [N/m]. 3n x 3n, its lower triangle [N/m]. It does not know what is inside: a
/// mode of it may squash what a volume's keeps.
///
/// Source: Sorkine & Alexa, As-rigid-as-possible surface modeling, SGP 2007.
SparseMatrix surface_arap_hessian(const Positions& positions,
                                  const std::vector<Triangle>& triangles, double stiffness);

/// A third of each triangle around a vertex [m^2].
Eigen::VectorXd surface_areas(const Positions& positions, const std::vector<Triangle>& triangles);

}  // namespace pleat
