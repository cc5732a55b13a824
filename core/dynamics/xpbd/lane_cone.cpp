#include "core/dynamics/xpbd/lane_cone.h"

#include <cmath>

namespace pleat {

LaneCone::LaneCone(const SweptCone& cone, const std::array<double, 2>& bare, double added)
    : has_width_(cone.has_width),
      axis_per_length_(static_cast<float>(cone.axis.per_length)),
      edge_per_length_(static_cast<float>(cone.edge.per_length)),
      length_(static_cast<float>(cone.axis.length)),
      half_width_(static_cast<float>(cone.half_width)),
      widening_(static_cast<float>(cone.widening)),
      edge_y_(static_cast<float>(cone.edge.direction.y())),
      edge_z_(static_cast<float>(cone.edge.direction.z())),
      square_a_(static_cast<float>(bare[0] * bare[0])),
      square_b_(static_cast<float>(bare[1] * bare[1])),
      added_(static_cast<float>(added)) {
  for (int k = 0; k < 9; ++k)
    to_local_[static_cast<std::size_t>(k / 3)][static_cast<std::size_t>(k % 3)] =
        static_cast<float>(cone.to_local(k / 3, k % 3));
}

// Faces' radii bring those of both ends nearer to each other.
bool LaneCone::is_regular(const SweptCone& cone, const std::array<double, 2>& bare) {
  constexpr double kLargestSine = 0.99;
  return std::abs(bare[1] - bare[0]) < kLargestSine * cone.axis.length;
}

}  // namespace pleat
