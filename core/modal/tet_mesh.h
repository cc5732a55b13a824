#pragma once

#include <array>
#include <vector>

#include "core/base/ids.h"
#include "core/base/vec.h"

namespace pleat {

/// Corners 1, 2 and 3, seen from corner 0, turn left about the way out: its volume is positive.
using Tet = std::array<VertexId, 4>;

/// A volume at rest.
struct TetMesh {
  Positions rest_positions;  ///< [m]
  std::vector<Tet> tets;     ///< each of positive volume

  int n_vertices() const { return static_cast<int>(rest_positions.cols()); }
};

/// Edges from corner 0 to the three others, one column each [m].
Mat3 tet_edges(const Positions& positions, const Tet& tet);

/// Signed: negative where the corners are turned inside out [m^3].
double tet_volume(const Positions& positions, const Tet& tet);

double total_volume(const TetMesh& mesh, const Positions& positions);

/// A quarter of each tetrahedron around it [m^3].
Eigen::VectorXd vertex_volumes(const TetMesh& mesh);

/// The part that each tetrahedron belongs to, from 0: those of a part hang together by whole faces.
std::vector<int> parts_by_faces(const TetMesh& mesh);

/// True where whatever hangs together does so by whole faces, not by an edge or a vertex alone.
bool hangs_together_by_faces(const TetMesh& mesh);

/// The part that each vertex belongs to, from 0: those of a part hang together by edges. Vertices
/// of no tetrahedron are parts of their own.
std::vector<int> parts_by_vertices(const TetMesh& mesh);

}  // namespace pleat
