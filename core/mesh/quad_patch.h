#pragma once

#include <array>
#include <vector>

#include "core/base/ids.h"
#include "core/base/vec.h"

namespace pleat {

/// Quads as a garment's pattern gives them, the base of a QuadMesh.
struct QuadPatch {
  Positions rest_positions;  ///< [m]
  /// Coordinates down along warp and round along weft [m], 2 x n. Where a tube closes the latter
  /// falls from its end to its start.
  RestCoordinates rest_coordinates;
  /// Corners run around the face, all wound alike; edges 0-1 and 3-2 lie along warp, 0-3 and 1-2
  /// along weft.
  std::vector<std::array<VertexId, 4>> quads;
};

double quad_area(const Positions& x, const std::array<VertexId, 4>& corners);  ///< [m^2]

/// Throws InputError naming a face that is not sound: a corner that does not exist or comes twice,
/// no area, an edge of a third face or wound against its neighbour's; or a vertex without a face.
void check_patch(const QuadPatch& patch);

/// True for the white ones of faces that are coloured like a chess board, neighbours differently as
/// far as rings of odd length allow.
std::vector<bool> chess_board(const QuadPatch& patch);

}  // namespace pleat
