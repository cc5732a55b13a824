#pragma once

#include "core/linalg/sparse.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// Bending of cloth on any triangle mesh as a constant Hessian: the lower triangle of Q [N/m], n x
/// n with every diagonal entry, such that positions X (3 x n) store
///
///     E = 1/2 trace(X Q X^T) = sum A/2 (B_warp |k_ww|^2 + B_weft |k_ff|^2 + 2 B_twist |k_wf|^2).
///
/// bend_warp, bend_weft  rigidity along the threads [N m], not negative
/// bend_twist            rigidity against torsion [N m], not negative; a sheet with all three equal
///                       bends alike in every direction
///
/// Curvature that the mesh does not see costs nothing (curvature_stencils). Throws ContractError
/// for a negative rigidity.
/// Source: docs/methods/fitted_bending.md.
SparseMatrix fitted_bending(const TriangleMesh& mesh, double bend_warp, double bend_weft,
                            double bend_twist);

}  // namespace pleat
