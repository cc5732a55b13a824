#pragma once

#include "core/mesh/quad_mesh.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// Ways to cut a sheet into triangles.
enum class SheetPattern {
  one_way,      ///< diagonals of the cells all parallel
  alternating,  ///< diagonals like a chess board
  crossed,      ///< both diagonals, with a vertex where they meet
  equilateral,  ///< every second row shifted by half a cell; equal sides if the cells fit
};

/// The sheet in one layer of triangles, wound like its cells. Vertices run along rows, upper row
/// first.
///
/// crossed      the middles of the cells come after all rows
/// equilateral  every second row has one vertex more, as its ends stay at the borders; triangles
///              are equilateral where cells are sqrt(3)/2 as high as wide
/// Throws ContractError as QuadMesh::sheet does.
TriangleMesh patterned_sheet(const SheetShape& shape, SheetPattern pattern);

/// How many vertices that has.
std::int64_t n_patterned_vertices(const SheetShape& shape, SheetPattern pattern);

}  // namespace pleat
