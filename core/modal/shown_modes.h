#pragma once

#include "core/modal/key_completion.h"

namespace pleat {

/// Modes as a surface shows them, the rigid ones left out.
struct SurfaceModes {
  /// 3 n x modes, each as large as lets the farthest vertex move by 1.
  Eigen::MatrixXd moves;
  Eigen::VectorXd stiffness;  ///< stiffness of each, as in Modes
  Eigen::VectorXd residuals;  ///< residual of each, as in Modes
  int n_rigid = 0;            ///< number of rigid modes left out
  /// Number of others left out that cost next to nothing, as a free cloth's turns do, or a flat
  /// surface's twist, which its own energy does not see.
  int n_costless = 0;
  int n_tets = 0;  ///< tetrahedra of the volume that carries the surface; 0 without

  Eigen::Index size() const { return moves.cols(); }
};

/// Modes whose unknowns are the surface's own.
SurfaceModes whole_surface_modes(const Modes& modes);

/// Modes of the volume that carries the surface, under the energy of 1 Pa and 1 kg/m^3. Throws
/// InputError where there is none, or fewer modes than are asked for.
SurfaceModes volume_surface_modes(const Positions& surface, const std::vector<Triangle>& triangles,
                                  const ModalOptions& options);

/// Modes of the surface alone, of 1 N/m and 1 kg/m^2. Throws InputError for a vertex in no triangle
/// and where it has fewer modes than `count`.
SurfaceModes surface_modes(const Positions& surface, const std::vector<Triangle>& triangles,
                           int count);

/// How much of a completed motion is in the first modes of the first key's volume, its rigid ones
/// first (motion_shares). Throws InputError for a surface of several parts.
Eigen::VectorXd volume_motion_shares(const KeyCompletion& completion,
                                     const std::vector<KeyCompletion::Frame>& frames);

}  // namespace pleat
