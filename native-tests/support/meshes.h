#pragma once

#include "core/base/random.h"
#include "core/mesh/quad_mesh.h"

namespace pleat {

/// A sheet of 1 m x 1 m with `cells` x `cells` square cells, hanging from u = 0.
QuadMesh square_sheet(int cells);

/// A sheet of rows x columns cells, each `aspect` times as long along warp as along weft; 1 m wide.
QuadMesh sheet_with_aspect(int rows, int columns, double aspect);

/// `x` with every coordinate moved by up to `amount` [m].
Positions shaken(const Positions& x, double amount, Random& random);

/// The sheet rolled along warp (or along weft) into a circular cylinder, every edge keeping its
/// length: an inscribed polyline that turns by `turn` [rad] from edge to edge.
Positions rolled_along_warp(const QuadMesh& mesh, int rows, double turn);
Positions rolled_along_weft(const QuadMesh& mesh, int columns, double turn);

}  // namespace pleat
