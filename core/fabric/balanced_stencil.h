#pragma once

#include <vector>

#include "core/fabric/curvature_stencil.h"

namespace pleat {

/// One stencil per triangle, exact for quadratics like those of curvature_stencils, whose sum of
/// area times weight vanishes at every vertex away from the border.
///
/// Cloth bent to one curvature needs no forces inside; by the fits alone it would lose up to a
/// third of its bending energy in ripples. Here a triangle's mean of the second derivatives is the
/// sum over its edges of length times outward normal times gradient at the edge's middle, over its
/// area (divergence theorem). The gradient is one and the same for both triangles beside an edge:
/// along it from its ends; across it from the two corners beyond, corrected by the fitted second
/// derivatives where these corners do not mirror one another. On parallelograms nothing is left to
/// correct, and both kinds of stencil agree.
///
/// Throws ContractError unless each triangle has a warp direction.
/// Source: docs/methods/fitted_bending.md (derivation; the condition is the patch test of Irons &
/// Loikkanen, An engineers' defence of the patch test, Int. J. Numer. Methods Eng. 19, 1983).
std::vector<CurvatureStencil> balanced_stencils(const TriangleMesh& mesh);

}  // namespace pleat
