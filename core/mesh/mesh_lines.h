#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/mesh/quad_mesh.h"

namespace pleat {

enum class Thread : std::uint8_t { warp, weft };

/// An edge of one or two active faces. Along the border of two levels the coarser face's edge and
/// the halves of the finer ones lie side by side.
struct ThreadEdge {
  VertexId from, to;  ///< ends in the direction in which its first face's coordinates grow
  Thread thread = Thread::warp;
  int level = 0;                ///< level of its faces
  double length = 0;            ///< rest length [m]
  double width = 0;             ///< half of its faces' widths across, summed [m]
  std::array<FaceId, 2> faces;  ///< the second is invalid at a border
};

struct ThreadEdges {
  std::vector<ThreadEdge> edges;  ///< warp, then weft, each in the order of the faces
  /// The edges 0-1, 3-2, 0-3 and 1-2 of each active face in order.
  std::vector<std::array<int, 4>> of_faces;
};

/// Throws ContractError when two faces do not agree on the thread of a common edge.
ThreadEdges thread_edges(const QuadMesh& mesh);

/// Three consecutive vertices of a mesh line.
struct LineChord {
  VertexId before, middle, after;
  double arm_before = 0, arm_after = 0;  ///< rest lengths of the two edges [m]
  double width = 0;                      ///< width of the strip that the line stands for [m]
  Thread thread_before = Thread::warp, thread_after = Thread::warp;
};

/// The lines of a mesh run straight through vertices of four faces and along borders. At any other
/// vertex those two edges are one line that are most nearly opposite in the rest shape, within 60
/// degrees. No chord has a hanging vertex in its middle; along the border of two levels lines join
/// vertices that do not hang, and have half the width of either side's faces; where one crosses the
/// border it has the coarser width. Ends may hang.
std::vector<LineChord> line_chords(const QuadMesh& mesh, const ThreadEdges& edges);

/// The far corners of two faces of one level that lie opposite one another at a vertex of four.
struct DiagonalChord {
  VertexId before, middle, after;
};
std::vector<DiagonalChord> diagonal_chords(const QuadMesh& mesh);

}  // namespace pleat
