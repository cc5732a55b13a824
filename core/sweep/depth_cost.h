#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// Cost of distances from a closed surface at random places in and around it, and how right they
/// are.
struct DepthCost {
  double build_ms = 0;  ///< time of what is made once of the surface
  double query_ms = 0;  ///< time of all distances
  std::size_t bytes = 0;
  int n_checked = 0;         ///< places that were looked at again, triangle by triangle
  double largest_error = 0;  ///< largest error of their distances [m]
  int n_wrong_sides = 0;     ///< signs that are not those of the surface's winding number
};

/// places, triangles  closed and wound outward [m]
DepthCost depth_cost(const Positions& places, const std::vector<Triangle>& triangles, int n_places,
                     std::uint64_t seed);

}  // namespace pleat
