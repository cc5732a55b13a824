#pragma once

#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// How far cloth reaches at rest, however it lies and is cut into triangles [m]: the root of twelve
/// times the mean over its area of the squared distance from its middle. Of a rectangle it is the
/// diagonal. Throws ContractError for a mesh without area.
double cloth_extent(const TriangleMesh& mesh);

}  // namespace pleat
