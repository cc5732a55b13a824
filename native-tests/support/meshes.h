#pragma once

#include <array>

#include "core/base/random.h"
#include "core/mesh/quad_mesh.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// A sheet of 1 m x 1 m with `cells` x `cells` square cells, hanging from u = 0.
QuadMesh square_sheet(int cells);

/// Square sheet in the plane z = 0, x along warp from the origin.
QuadMesh lying_sheet(int cells);

/// A sheet of rows x columns cells, each `aspect` times as long along warp as along weft; 1 m wide.
QuadMesh sheet_with_aspect(int rows, int columns, double aspect);

/// `x` with every coordinate moved by up to `amount` [m].
Positions shaken(const Positions& x, double amount, Random& random);

/// The sheet rolled along warp (or along weft) into a circular cylinder, every edge keeping its
/// length: an inscribed polyline that turns by `turn` [rad] from edge to edge.
Positions rolled_along_warp(const QuadMesh& mesh, int rows, double turn);
Positions rolled_along_weft(const QuadMesh& mesh, int columns, double turn);

/// Ways to cut a sheet into triangles.
enum class Triangulation {
  one_way,      ///< squares, all diagonals parallel
  alternating,  ///< squares, diagonals like a chess board
  crossed,      ///< squares with a vertex in the middle
  equilateral,
  jittered,  ///< equilateral triangles with moved vertices, Delaunay: vertices of 3 to 8 triangles
};

constexpr std::array<Triangulation, 5> kTriangulations = {
    Triangulation::one_way, Triangulation::alternating, Triangulation::crossed,
    Triangulation::equilateral, Triangulation::jittered};

/// A flat sheet of `rows` x `columns` cells of side `edge` [m] in the plane z = 0, wound upward; x
/// runs along warp and rows. Equilateral rows are each shifted by half an edge.
TriangleMesh triangulated_sheet(Triangulation pattern, int rows, int columns, double edge);

/// The mesh as it stands, cut out flat triangle by triangle.
std::vector<CornerTexture> pattern_of(const TriangleMesh& mesh);

/// A flat mesh rolled into a cylinder of `radius` [m] that bends along the direction at `angle`
/// [rad] from x; lengths on the surface stay.
Positions on_cylinder(const Positions& flat, double angle, double radius);

}  // namespace pleat
