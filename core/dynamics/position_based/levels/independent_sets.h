#pragma once

#include <array>
#include <vector>

namespace pleat {

/// Two places that an element joins.
using PlacePair = std::array<int, 2>;

/// Sorts elements into sets in which no two share a place that moves: each goes into the first set
/// that has room for it, in their order. What a sweep over the sets makes of the places does not
/// depend on the order within a set.
///
/// Returns indices into `elements`, ascending in each set; `moves` is of each place.
std::vector<std::vector<int>> independent_sets(const std::vector<PlacePair>& elements,
                                               const std::vector<bool>& moves);

}  // namespace pleat
