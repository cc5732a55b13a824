#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// A fault that keeps triangles from being cloth, and its place.
struct MeshFault {
  FaceId triangle;       ///< invalid when a vertex in no triangle is at fault
  VertexId vertex;       ///< then this one
  std::string sentence;  ///< "expected ..., got ..."
};

/// The first fault of a mesh; none when it is sound: every triangle has an area, every edge at most
/// two triangles, which are wound alike and not the same three corners, and every vertex a
/// triangle.
///
/// Winding counts because the angle between two triangles has a sign: a sheet that meets itself the
/// other way around (a Moebius band) is no cloth.
///
/// positions     [m], finite
/// triangles     of vertices that are there
/// first_vertex  the number that vertex 0 has in sentences
std::optional<MeshFault> mesh_fault(const PositionsView& positions,
                                    const std::vector<Triangle>& triangles, int first_vertex);

}  // namespace pleat
