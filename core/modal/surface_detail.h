#pragma once

#include "core/modal/carrying_volume.h"

namespace pleat {

/// Carries along the part of a key's surface that the space of shapes does not have, by the patches
/// that the clusters of tetrahedra cut the surface into: each patch has a frame that turns with its
/// cluster, and a vertex between patches follows the mean of their frames.
class SurfaceDetail {
 public:
  /// cluster_of_tet  of the volume, from 0, without gaps
  SurfaceDetail(const CarryingVolume& carrying, const std::vector<int>& cluster_of_tet);

  /// A key's surface less what its shape in the space carries; patches where no vertex is farther
  /// off than the tolerance have none.
  ///
  /// residual  of each vertex of the surface [m]; made zero where it is left out
  /// Returns the number of patches that keep theirs.
  int keep_beyond(double tolerance, Positions& residual) const;

  /// Adds share * residual, turned by the rotations of the clusters since the key.
  void add(const Positions& residual, const std::vector<Mat3>& rotations, double share,
           Positions& surface) const;

 private:
  SparseMatrix shares_;  // clusters x vertices of the surface, columns of sum 1
};

}  // namespace pleat
