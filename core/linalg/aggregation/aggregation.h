#pragma once

#include <vector>

#include "core/linalg/aggregation/lower_pattern.h"

namespace pleat {

/// The nodes of a graph in connected groups.
struct Aggregates {
  std::vector<int> of_node;  ///< -1 where a node has no edge
  int count = 0;
};

/// Groups of about `size` nodes that are as compact as can be: a group takes the node that has most
/// neighbours in it, then the next. Groups that stay below half of the size join the one to which
/// they have most edges.
///
/// Groups are numbered as they are found, along the order of the nodes. Source: Vanek, Mandel &
/// Brezina, Algebraic multigrid by smoothed aggregation for second and fourth order
/// elliptic problems, Computing 56, 1996 (groups of neighbours; here their size is given).
Aggregates aggregate(const LowerPattern& graph, int size);

}  // namespace pleat
