#pragma once

#include "core/base/vec.h"

namespace pleat {

// Places in which cases begin, made from those at rest [m].

/// Every vertex where the first is.
Positions in_one_point(const Positions& rest);

/// The half beyond z = 0 laid back onto the other.
Positions folded_in_half(const Positions& rest);

/// Everything on the line x = z = 0.
Positions on_a_line(const Positions& rest);

/// Each second vertex changes its place with the next, where that is near.
Positions with_neighbours_swapped(const Positions& rest);

/// A vertical sheet rolled round the y axis, one side meeting the other.
Positions rolled_up(const Positions& rest);

/// A heap of half the cloth's size, crumpled in waves of 2 to 20 cm in all directions.
Positions crumpled(const Positions& rest);

}  // namespace pleat
