#pragma once

#include "core/modal/carrying_volume.h"

namespace pleat {

/// A box of these sides [m] about the origin as a closed surface of twelve triangles, wound
/// outward.
Positions box_corners(const Vec3& sides);
std::vector<Triangle> box_triangles();

/// Its sides cut into so fine triangles that the surface can bend.
struct FineBox {
  Positions positions;
  std::vector<Triangle> triangles;

  /// levels  each cuts every triangle into four
  explicit FineBox(const Vec3& sides, int levels = 4);
};

/// A bar along x bent to an arc of so many radians, its middle line keeping its length.
Positions bent(const Positions& straight, double angle);

/// Largest distance between a vertex in one shape and in another [m].
inline double farthest(const Positions& a, const Positions& b) {
  return (a - b).colwise().norm().maxCoeff();
}

/// Bar in a lattice of cubes [m].
CarryingVolume bar_volume(const Vec3& sides, double edge);

}  // namespace pleat
