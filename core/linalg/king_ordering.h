#pragma once

#include <vector>

namespace pleat {

/// An order of a graph's nodes in which neighbours are near each other: from a node at the rim,
/// next is always the neighbour of those taken that reaches the fewest new nodes; then reversed.
/// Returns the node at each place.
///
/// Takes time in proportion to the nodes times the width of the graph. Neighbours both ways.
/// Source: King, An automatic reordering scheme for simultaneous equations derived from network
/// systems, Int. J. Numer. Methods Eng. 2, 1970.
std::vector<int> reverse_king_ordering(const std::vector<std::vector<int>>& neighbours);

}  // namespace pleat
