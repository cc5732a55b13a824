#pragma once

#include <span>

#include "core/figure/mannequin.h"

namespace pleat {

/// How far a body reaches at a height, towards evenly spaced directions [m]: the support function
/// of the horizontal section's convex hull about the vertical axis through the origin.
///
/// Direction k of n is (cos a, 0, -sin a), a = 2 pi k / n: 0 is ahead, then comes the left side.
using Outline = Eigen::ArrayXd;

/// parts   lie across horizontally; those that the height misses do not count
/// height  [m]; throws ContractError where no part is
Outline outline(std::span<const BodyPart> parts, double height, int n_directions);

/// What a tape around it measures [m].
double girth(const Outline& outline);

/// Distance of a point from the nearest part [m], negative inside.
double clearance(std::span<const BodyPart> parts, const Vec3& point);

}  // namespace pleat
