#pragma once

#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// Form of a mesh, as its triangles tell it.
struct Topology {
  bool is_manifold = true;  ///< every vertex is one fan, and edges have one or two triangles
  int n_components = 0;
  int n_border_loops = 0;
  int euler = 0;  ///< vertices - edges + triangles
};

Topology topology(const std::vector<Triangle>& triangles, int n_vertices);

}  // namespace pleat
