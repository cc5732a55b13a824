#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/base/ids.h"

namespace pleat {

/// Vertices that go by a name, such as those of a waist.
struct VertexGroup {
  std::string name;
  std::vector<VertexId> vertices;  ///< ascending, each once
};

/// The group in a refinement of so many vertices: it gets the middle of every edge whose two ends
/// are in it. `middles` are the ends of each edge split, in the order of the middles appended.
VertexGroup refined(VertexGroup group, int n_vertices,
                    std::span<const std::array<VertexId, 2>> middles);

}  // namespace pleat
