#pragma once

#include "core/base/vec.h"
#include "core/mesh/quad_mesh.h"

namespace pleat {

/// Places of the vertices of a refinement on a smooth surface through those of its base, where
/// midpoints lie on the base's flat faces. Hanging vertices stay in the middle of their parents.
///
/// Edges of the base are cubic arcs (Hermite) with the tangents that circles of mesh lines have
/// there; a line's end has no curvature, and a line ends where it turns by more than 60 degrees.
/// Inside, a face blends its four edges (Coons).
///
/// base     unrefined, at rest
/// refined  from it, in any way
/// Returns 3 x n positions [m]; those of base vertices are the base's. Throws ContractError when
/// refined is not of this base.
/// Source: Coons, Surfaces for computer-aided design of space forms, MIT MAC-TR-41, 1967.
Positions on_smooth_surface(const QuadMesh& base, const QuadMesh& refined);

}  // namespace pleat
