#pragma once

#include <array>
#include <vector>

#include "core/mesh/triangle_tree.h"

namespace pleat {

/// Distance from a closed surface, negative inside.
class SignedDistance {
 public:
  /// places     [m]
  /// triangles  closed and wound so that normals lead out; none without area
  SignedDistance(const PositionsView& places, const std::vector<Triangle>& triangles);

  /// [m]. Exact to rounding; the sign is right too, but for places within rounding of the surface.
  /// Quick when asked in an order in which each place is near the one before.
  double at(const Vec3& place);

  /// Memory that it holds [bytes].
  std::size_t bytes() const;

 private:
  /// Normals of a triangle, of what it is nearest by: each is of the surface's mean direction
  /// there, of no particular length.
  struct Normals {
    Vec3 face;
    std::array<Vec3, 3> edges;  // edge across from each corner
    std::array<Vec3, 3> corners;
  };

  std::vector<Corners> corners_;
  std::vector<Normals> normals_;
  TriangleTree tree_;
};

}  // namespace pleat
