#pragma once

#include "core/linalg/sparse.h"
#include "core/modal/tet_mesh.h"

namespace pleat {

/// A tetrahedron at rest, as energies see it.
struct TetElement {
  Tet tet;
  Eigen::Matrix<double, 4, 3> to_gradient;  ///< F = corner positions (3 x 4) times this [1/m]
  double volume;                            ///< [m^3], positive

  Mat3 deformation_gradient(const Positions& positions) const;
  /// Adds the derivatives by the corners' places of an energy whose derivative by F is `stress` for
  /// each unit of volume.
  void add_pulls(const Mat3& stress, Positions& pulls) const;
};

/// Throws ContractError where a tetrahedron has no volume.
std::vector<TetElement> tet_elements(const TetMesh& rest);

/// sum_t V G G', the lower triangle: X L X' = sum_t V |F_t|^2 for places X (3 x n) [m].
SparseMatrix laplacian(int n_vertices, const std::vector<TetElement>& elements);

}  // namespace pleat
