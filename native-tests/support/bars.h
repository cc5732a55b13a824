#pragma once

#include "core/modal/carrying_volume.h"

namespace pleat {

/// A box of these sides [m] about the origin as a closed surface of twelve triangles, wound
/// outward.
Positions box_corners(const Vec3& sides);
std::vector<Triangle> box_triangles();

/// The same in a lattice of cubes [m].
CarryingVolume bar_volume(const Vec3& sides, double edge);

}  // namespace pleat
