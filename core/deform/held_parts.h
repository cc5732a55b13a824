#pragma once

#include <cstdint>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// How held vertices keep a part of a mesh from moving as a rigid body.
enum class Hold : std::uint8_t {
  none,   ///< nothing is held: it can go anywhere
  point,  ///< one place: it can turn about it
  line,   ///< places on a line: it can turn about that
  firm,   ///< three places or more, not on a line
};

/// Triangles that hang together by their edges. Where parts touch in a vertex alone, neither is
/// said to hold the other.
struct HeldPart {
  VertexId first;      ///< the least of its vertices
  int n_vertices = 0;  ///< a vertex that parts share counts in each
  Hold hold = Hold::none;
};

/// The parts of a mesh by their first vertex.
///
/// held     vertices of the mesh, in any order
/// targets  where they are held [m], one column each. Places are one within a millionth of the
/// part's
///          size at rest, and on a line within a millionth of their own extent, or where no digits
///          are left to tell them apart
std::vector<HeldPart> held_parts(const TriangleMesh& mesh, const std::vector<VertexId>& held,
                                 const PositionsView& targets);

}  // namespace pleat
