#pragma once

#include <span>
#include <vector>

#include "core/body/mannequin.h"

namespace pleat {

/// How far a body reaches at a height, towards evenly spaced directions [m]: the support function
/// of the horizontal section's convex hull about the vertical axis through the origin.
///
/// Direction k of n is (cos a, 0, -sin a), a = 2 pi k / n: 0 is ahead, then comes the left side.
using Outline = Eigen::ArrayXd;

/// parts   lie across horizontally; those that the height misses do not count
/// height  [m]; throws ContractError where no part is
Outline outline(std::span<const BodyPart> parts, double height, int n_directions);

/// The length of a tape around the section [m].
double girth(const Outline& outline);

/// The first point of a line and those at whole multiples of one n-th of its length.
std::vector<Vec3> evenly_spaced(std::span<const Vec3> line, int n_points);

/// Points at equal distances along the curve `offset` [m] outside of an outline, at a height [m]:
/// the first in the middle of the front, then round by the left side.
std::vector<Vec3> ring(const Outline& outline, double offset, double height, int n_points);

/// Distance of a point from the nearest part [m], negative inside.
double clearance(std::span<const BodyPart> parts, const Vec3& point);

}  // namespace pleat
