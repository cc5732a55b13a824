#pragma once

#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// Second derivatives over one triangle of any function given at vertices; of the positions they
/// are the curvature vectors k_ww, k_ff, k_wf [1/m].
struct CurvatureStencil {
  std::vector<VertexId> vertices;  ///< each once
  /// Rows: along warp twice, along weft twice, along warp and weft; a column per vertex [1/m^2].
  Eigen::Matrix<double, 3, Eigen::Dynamic> weights;
  double area = 0;  ///< rest area of the triangle [m^2]
};

/// One stencil per triangle: a quadratic through its corners and those of the three triangles
/// beside it, unfolded into its plane. At a border, and where these six lie on or near a conic, the
/// quadratic nearest to the vertices of the triangles around it, in one ring or else two.
///
/// Exact for quadratic functions of the unfolded rest coordinates, zero for affine ones. Where two
/// rings do not determine a quadratic, the derivatives they say nothing about are zero: a strip one
/// triangle wide bends along and twists but does not see bending across, one triangle sees nothing.
/// Throws ContractError unless each triangle has a warp direction.
/// Source: Grinspun, Gingold, Reisman & Zorin, Computing discrete shape operators on general
/// meshes, Computer Graphics Forum 25(3) (Eurographics), 2006.
std::vector<CurvatureStencil> curvature_stencils(const TriangleMesh& mesh);

}  // namespace pleat
