#pragma once

#include "core/modal/tet_mesh.h"

namespace pleat {

/// A tetrahedron at rest, as energies see it.
struct TetElement {
  Tet tet;
  Eigen::Matrix<double, 4, 3> to_gradient;  ///< F = corner positions (3 x 4) times this [1/m]
  double volume;                            ///< [m^3], positive

  Mat3 deformation_gradient(const Positions& positions) const;
};

/// Throws ContractError where a tetrahedron has no volume.
std::vector<TetElement> tet_elements(const TetMesh& rest);

}  // namespace pleat
