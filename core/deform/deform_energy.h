#pragma once

#include <array>
#include <vector>

#include "core/deform/curvature_energy.h"
#include "core/fabric/deform_weights.h"
#include "core/fabric/membrane.h"
#include "core/linalg/sparse.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

enum class EnergyForm {
  consistent,  ///< integrals over the cloth: one shape on any mesh
  published,   ///< sums over vertices and edges, as the source has them
};

constexpr const char* name(EnergyForm form) {
  return form == EnergyForm::consistent ? "consistent" : "published";
}

/// The cost of a shape, term by term and without weights; numbers without unit.
struct DeformTerms {
  double recovery = 0;  ///< E_P: distance from where it lay
  double stretch = 0;   ///< E_L
  double bending = 0;   ///< E_A

  double weighted(const DeformWeights& weights) const {
    return weights.recovery * recovery + weights.stretch * stretch + weights.bending * bending;
  }
};

/// E = omega_R E_P + omega_S E_L + omega_B E_A of a triangle mesh, whose rest shape costs nothing.
///
///     published:   E_P = sum_free |x_i - m_i|^2/l^2,   l the mean edge at rest,
///                  E_L = sum_edges (|e| - |e_M|)^2/l^2,
///                  E_A = sum_inner edges (theta - theta_M)^2, theta the turn at an edge;
///     consistent:  E_P = sum_free A_i |x_i - m_i|^2/l^4, l = cloth_extent/20,
///                  E_L = sum_faces A (E:E + tr(E)^2/2)/l^2, E the Green strain,
///                  E_A = sum_faces A |k - k_M|^2, k the fitted second derivatives
///                        (balanced_stencils), k_M those at rest, turned along with the face.
///
/// Source: Liu, Wang & Luo, Realistic cloth simulation based on geometrical measurement and
/// deformation, Journal of Software 26(7), 2015; docs/methods/deformation.md.
class DeformEnergy {
 public:
  /// mesh  at rest. Throws ContractError without triangles, for triangles without area, and, for
  ///       `consistent`, unless each triangle has a warp direction.
  DeformEnergy(const TriangleMesh& mesh, EnergyForm form);

  /// These vertices do not count in E_P; the others do.
  void hold(const std::vector<VertexId>& vertices);

  const Positions& rest_positions() const { return rest_; }

  DeformTerms terms(const PositionsView& positions) const;

  /// E_A split among the vertices: where a shape is wrinkled.
  Eigen::VectorXd bending_shares(const PositionsView& positions) const;

  /// dE/dx [1/m].
  Positions gradient(const DeformWeights& weights, const PositionsView& positions) const;

  /// The lower triangle of a matrix H, n x n [1/m^2], with which a step of least energy is about
  /// -H^-1 dE/dx, one coordinate like the other: the mean over directions of 2 J^T W J, with the
  /// residuals' derivatives J, and of what tension adds, as cloth under tension resists moving
  /// sideways. Of the bending of a shape that is not flat at rest, the share that turns with the
  /// normal is left out. Positive semidefinite; entries of terms without weight are missing.
  SparseMatrix metric(const DeformWeights& weights, const PositionsView& positions) const;

 private:
  struct EdgeLength {
    VertexId a, b;
    double rest = 0;  // [m]
  };
  struct Dihedral {
    std::array<VertexId, 4> vertices;  // ordered as in Hinge
    double rest = 0;
  };

  void build_sums(const TriangleMesh& mesh);
  void build_integrals(const TriangleMesh& mesh);
  void add_stretch_gradient(double weight, const PositionsView& positions,
                            Positions& gradient) const;
  void add_bending_gradient(double weight, const PositionsView& positions,
                            Positions& gradient) const;
  SparseMatrix constant_metric(const DeformWeights& weights) const;
  void add_stretch_metric(double weight, const PositionsView& positions, SparseMatrix& lower) const;
  void add_turn_metric(double weight, const PositionsView& positions, SparseMatrix& lower) const;

  Positions rest_;
  double unit_ = 1;
  Eigen::VectorXd recovery_factors_;  // factor of each vertex [1/m^2], as if free
  Eigen::VectorXd is_free_;           // 1 or 0
  std::vector<EdgeLength> edges_;
  Membrane membrane_;
  std::vector<Dihedral> dihedrals_;
  std::vector<CurvatureElement> curvatures_;
  SparseMatrix bending_metric_;  // metric of curvatures_, the same at all positions
};

}  // namespace pleat
