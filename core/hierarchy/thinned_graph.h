#pragma once

#include <array>
#include <vector>

#include "core/base/ids.h"
#include "core/base/vec.h"

namespace pleat {

/// Neighbours of each vertex.
using Neighbours = std::vector<std::vector<VertexId>>;

/// Graph after thinning.
struct ThinnedGraph {
  std::vector<VertexId> kept;  ///< ascending
  /// Edges between vertices that are kept, the lower number first, ascending, each once.
  std::vector<std::array<VertexId, 2>> edges;
};

/// Takes vertices out, in their order, as long as each one that is out has two neighbours or more
/// that stay. An edge to one that is out goes to the nearest of these instead.
///
/// positions  of the vertices at rest [m]
/// is_fixed   of each vertex; these stay
/// Source: Mueller, Hierarchical position based dynamics, VRIPHYS 2008, section 4.
ThinnedGraph thinned(const Neighbours& neighbours, const Positions& positions,
                     const std::vector<bool>& is_fixed);

}  // namespace pleat
