#pragma once

#include <span>
#include <vector>

#include "core/fabric/element_hessian.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// Bending about an inner edge: E = 1/2 c theta^2 with theta the turn from one triangle to the
/// other, 0 when flat, between -pi and pi.
struct Hinge {
  std::array<VertexId, 4> vertices;  ///< the edge, then the corner across on either side
  double stiffness = 0;              ///< c [J]
};

/// The turn theta at an edge and its derivative by the four vertices, a column for each [1/m].
struct HingeTurn {
  double angle = 0;
  Eigen::Matrix<double, 3, 4> gradient = Eigen::Matrix<double, 3, 4>::Zero();
};

/// vertices  as in Hinge
/// Zero with a flap of no area, which turns nowhere.
HingeTurn hinge_turn(const std::array<VertexId, 4>& vertices, const PositionsView& positions);

/// One hinge per inner edge, at rest when flat, with c = B l^2 / (A1 + A2): edge length l, areas A1
/// and A2 beside it.
///
/// rigidity  B [N m], the same in every direction, not negative
///
/// Right for equilateral triangles; others bend unlike by direction (docs/methods/fitted_bending.md
/// has the numbers). A hinge with a flap of no area bends nowhere: no energy, no force, no
/// stiffness. Throws ContractError for a negative rigidity or triangles without area at rest.
/// Source: Grinspun, Hirani, Desbrun & Schröder, Discrete shells, SCA 2003; Tamstorf & Grinspun,
/// Discrete bending forces and their Jacobians, Graphical Models 75(6), 2013.
std::vector<Hinge> hinges(const TriangleMesh& mesh, double rigidity);

/// Energy stored [J].
double hinge_energy(std::span<const Hinge> hinges, const PositionsView& positions);

/// Adds the forces on vertices [N].
void add_hinge_forces(std::span<const Hinge> hinges, const PositionsView& positions,
                      PositionsRef forces);

/// -d(forces)/d(positions) of one hinge [N/m], in 3 x 3 blocks by vertex. Projected: without its
/// negative eigenvalues.
Eigen::Matrix<double, 12, 12> hinge_stiffness(const Hinge& hinge, const PositionsView& positions,
                                              ElementHessian hessian);

}  // namespace pleat
