#pragma once

#include <span>
#include <vector>

#include "core/linalg/sparse.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// The difference r of a triangle's second derivatives k_ww, k_ff, k_wf from those at rest:
///
///     r = sum_i w_i x_i - b n,
///
/// zero at rest wherever that is moved to, as the part of k_M in the plane is among the weights.
struct CurvatureElement {
  std::vector<VertexId> vertices;                    ///< the corners first; each once
  Eigen::Matrix<double, 3, Eigen::Dynamic> weights;  ///< w, a column per vertex [1/m^2]
  Vec3 normal_part = Vec3::Zero();                   ///< b = n.k_M [1/m]
  double area = 0;                                   ///< rest area [m^2]
};

/// One element per triangle, from balanced_stencils. Throws ContractError unless each triangle has
/// area and a warp direction.
std::vector<CurvatureElement> curvature_elements(const TriangleMesh& mesh);

/// Sum of A (|r_ww|^2 + |r_ff|^2 + 2 |r_wf|^2). A triangle without area has no normal: there b n is
/// left out.
double curvature_energy(std::span<const CurvatureElement> elements, const PositionsView& positions);

/// Adds each triangle's share in thirds to its corners, one number per vertex.
void add_curvature_shares(std::span<const CurvatureElement> elements,
                          const PositionsView& positions, Eigen::Ref<Eigen::VectorXd> shares);

/// Adds factor times the derivative of the energy [1/m].
void add_curvature_gradient(std::span<const CurvatureElement> elements, double factor,
                            const PositionsView& positions, PositionsRef gradient);

/// The share of sum_i w_i x_i in 2 J^T W J, J = dr/dx: the lower triangle of a matrix n x n for
/// each coordinate alike [1/m^2]. It does not depend on the positions.
SparseMatrix curvature_metric(std::span<const CurvatureElement> elements, int n_vertices);

}  // namespace pleat
