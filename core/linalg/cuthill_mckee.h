#pragma once

#include <vector>

namespace pleat {

/// An order of a graph's nodes in which neighbours are near each other: breadth first from a node
/// at the rim, nodes of few neighbours first, then reversed. Returns the node at each place.
///
/// neighbours  of each node, both ways, without the node itself
/// Sources: Cuthill & McKee, Reducing the bandwidth of sparse symmetric matrices, Proc. 24th ACM
/// National Conference, 1969; George, Computer implementation of the finite element method,
/// Stanford STAN-CS-71-208, 1971.
std::vector<int> reverse_cuthill_mckee(const std::vector<std::vector<int>>& neighbours);

}  // namespace pleat
