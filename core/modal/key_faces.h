#pragma once

#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// Throws InputError unless a key shape has as many vertices as the surface and its faces join the
/// same vertices, in any order.
void check_key_faces(Eigen::Index n_vertices, const std::vector<Triangle>& triangles,
                     Eigen::Index n_key_vertices, const std::vector<Triangle>& key_triangles);

}  // namespace pleat
