#pragma once

#include "core/modal/shape_space.h"

namespace pleat {

/// Tetrahedra that deform alike in all shapes of a space: the number, from 0, of each one's
/// cluster. Two tetrahedra whose functions have the same gradients have the same deformation
/// gradient in every shape; these gradients, of the heaviest functions, are what k-means compares.
/// At most `count` clusters, none empty; the same for the same input.
///
/// Source: Arthur & Vassilvitskii, k-means++: the advantages of careful seeding, SODA 2007.
std::vector<int> shape_clusters(const TetMesh& rest, const ShapeSpace& space, int count);

}  // namespace pleat
