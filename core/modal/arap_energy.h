#pragma once

#include "core/linalg/sparse.h"
#include "core/modal/tet_element.h"

namespace pleat {

/// As-rigid-as-possible energy of a volume:
///
///     E(x) = sum_t w V_t min_R |F_t - R|^2      [J]
///
/// with the deformation gradients F_t of the tetrahedra, their rest volumes V_t, and the rotation R
/// nearest to F_t. At rest its Hessian is that of linear elasticity without Poisson's effect and
/// with Young's modulus 2 w.
///
/// Source: Sorkine & Alexa, As-rigid-as-possible surface modeling, SGP 2007; Chao et al., A simple
/// geometric model for elastic deformations, SIGGRAPH 2010.
class ArapEnergy {
 public:
  /// stiffness  w [Pa], positive
  /// Throws ContractError where a tetrahedron has no volume.
  ArapEnergy(const TetMesh& rest, double stiffness);

  double energy(const Positions& positions) const;
  /// The energy; sets `gradient` [N].
  double energy_and_gradient(const Positions& positions, Positions& gradient) const;
  /// Hessian by flat(positions), its lower triangle, rotations differentiated [N/m]. Indefinite
  /// under compression; at rest positive semidefinite, with the rigid motions of each part that
  /// hangs together by faces in its null space and nothing else.
  ///
  /// Source: Smith, de Goes & Kim, Analytic eigensystems for isotropic distortion energies, ACM
  /// Transactions on Graphics 38, 2019.
  SparseMatrix hessian(const Positions& positions) const;

 private:
  int n_vertices_;
  double stiffness_;
  std::vector<TetElement> elements_;
};

}  // namespace pleat
