#pragma once

#include <array>

#include "core/base/vec.h"

namespace pleat {

/// Closest points of a pair's sides.
struct ClosestPoints {
  /// One for each vertex of the pair, from 0 to 1; they sum to 1 on either side.
  std::array<double, 4> weights{};
  /// The second side's point less the first's [m]. It is found from normals, not from the weights:
  /// its direction is good to rounding however little it is against the sides.
  Vec3 difference{0, 0, 0};
};

/// differences  from each vertex of the first side to each of the second [m], as pair_differences
///              orders them
/// count        3 of a vertex and a face, 4 of two edges
///
/// Sides without length or width are points and lines. Where a face is a needle or edges run side
/// by side, with a sine of 1e-8, the distance may be off by some 1e-8 of their length. Nothing is
/// told of differences that are not finite. Source: docs/methods/contact.md.
ClosestPoints closest_points(const std::array<Vec3, 4>& differences, int count);

}  // namespace pleat
