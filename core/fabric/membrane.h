#pragma once

#include <vector>

#include "core/fabric/element_hessian.h"
#include "core/fabric/fabric.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// Energy per rest area 1/2 (K_u E11^2 + K_v E22^2 + 2 G E11 E22 + G (2 E12)^2) with the Green
/// strain E in thread directions.
struct MembraneLaw {
  double stretch_warp = 0;  ///< K_u [N/m], not negative
  double stretch_weft = 0;  ///< K_v [N/m], not negative
  double shear = 0;         ///< G [N/m], not negative, at most sqrt(K_u K_v)
  /// Engineering strain along warp or weft beyond which the thread is ten times as stiff, in
  /// tension only; 0: linear throughout.
  double stiffening_strain = 0;
};

struct MembraneElement {
  Triangle vertices;
  /// Derivatives of the three shape functions along warp (u) and weft (v) [1/m]; a row per vertex.
  Eigen::Matrix<double, 3, 2> gradients;
  double area = 0;  ///< rest area [m^2]
};

/// Cloth in its own surface: triangles of an orthotropic St. Venant-Kirchhoff material.
///
/// Any positions are admissible, triangles of no area or turned over too. Under strong compression
/// the material gives way, as Green strain never falls below -1/2.
/// Source: Volino, Magnenat-Thalmann & Faure, A simple approach to nonlinear tensile stiffness for
/// accurate cloth simulation, ACM Transactions on Graphics 28(4), 2009; docs/methods/membrane.md.
struct Membrane {
  MembraneLaw law;
  std::vector<MembraneElement> elements;
};

/// One element per triangle. Throws ContractError unless each triangle has area and a warp
/// direction.
std::vector<MembraneElement> membrane_elements(const TriangleMesh& mesh);

/// The moduli that the spring lattice has, without stiffening. Throws InputError naming the
/// fabric when its shear stiffness is beyond sqrt(K_u K_v), where biaxial strain would yield
/// energy.
MembraneLaw membrane_law(const FabricConstants& fabric);

/// Energy stored [J].
double membrane_energy(const Membrane& membrane, const PositionsView& positions);

/// Adds the forces on vertices [N].
void add_membrane_forces(const Membrane& membrane, const PositionsView& positions,
                         PositionsRef forces);

/// -d(forces)/d(positions) of one element [N/m], in 3 x 3 blocks by vertex. Projected: without the
/// part of compressive stress.
Mat9 membrane_stiffness(const MembraneLaw& law, const MembraneElement& element,
                        const PositionsView& positions, ElementHessian hessian);

/// The part of the stiffness that resists a change of strain, without stiffening [N/m]. Times
/// a relaxation time [s] it is the damping of a Kelvin-Voigt material [N s/m]: positive
/// semidefinite, and rotation is not braked.
Mat9 membrane_viscosity(const MembraneLaw& law, const MembraneElement& element,
                        const PositionsView& positions);

}  // namespace pleat
