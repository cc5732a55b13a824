#include "core/mesh/vertex_group.h"

namespace pleat {

VertexGroup refined(VertexGroup group, int n_vertices,
                    std::span<const std::array<VertexId, 2>> middles) {
  std::vector<bool> is_in(static_cast<std::size_t>(n_vertices) + middles.size(), false);
  for (const VertexId v : group.vertices) is_in[v] = true;
  VertexId middle(n_vertices);
  for (const auto& [a, b] : middles) {
    if (is_in[a] && is_in[b]) {
      is_in[middle] = true;
      group.vertices.push_back(middle);
    }
    ++middle.value;
  }
  return group;
}

}  // namespace pleat
