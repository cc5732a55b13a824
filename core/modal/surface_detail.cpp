#include "core/modal/surface_detail.h"

#include <algorithm>

#include "core/base/check.h"

namespace pleat {

// A vertex of the volume has of each cluster the share of the tetrahedra around it by volume.
SurfaceDetail::SurfaceDetail(const CarryingVolume& carrying,
                             const std::vector<int>& cluster_of_tet) {
  const TetMesh& volume = carrying.volume;
  PLEAT_CHECK(cluster_of_tet.size() == volume.tets.size() && !volume.tets.empty(),
              "every tetrahedron is of a cluster");
  const int n_clusters = 1 + *std::max_element(cluster_of_tet.begin(), cluster_of_tet.end());
  const Eigen::VectorXd quarters = vertex_volumes(volume);
  std::vector<Eigen::Triplet<double, int>> entries;
  for (std::size_t t = 0; t < volume.tets.size(); ++t)
    for (const VertexId v : volume.tets[t])
      entries.emplace_back(cluster_of_tet[t], v,
                           tet_volume(volume.rest_positions, volume.tets[t]) / 4 / quarters[v]);
  SparseMatrix of_volume(n_clusters, volume.n_vertices());
  of_volume.setFromTriplets(entries.begin(), entries.end());
  shares_ = of_volume * carrying.embedding;
}

int SurfaceDetail::keep_beyond(double tolerance, Positions& residual) const {
  std::vector<bool> keeps(static_cast<std::size_t>(shares_.rows()), false);
  for (int v = 0; v < shares_.cols(); ++v)
    if (residual.col(v).norm() > tolerance)
      for (SparseMatrix::InnerIterator share(shares_, v); share; ++share)
        keeps[static_cast<std::size_t>(share.row())] = true;
  for (int v = 0; v < shares_.cols(); ++v) {
    bool kept = false;
    for (SparseMatrix::InnerIterator share(shares_, v); share; ++share)
      kept = kept || keeps[static_cast<std::size_t>(share.row())];
    if (!kept) residual.col(v).setZero();
  }
  return static_cast<int>(std::count(keeps.begin(), keeps.end(), true));
}

void SurfaceDetail::add(const Positions& residual, const std::vector<Mat3>& rotations, double share,
                        Positions& surface) const {
  for (int v = 0; v < shares_.cols(); ++v) {
    if (residual.col(v).isZero(0)) continue;
    Mat3 frame = Mat3::Zero();
    for (SparseMatrix::InnerIterator of(shares_, v); of; ++of)
      frame += of.value() * rotations[static_cast<std::size_t>(of.row())];
    surface.col(v) += share * frame * residual.col(v);
  }
}

}  // namespace pleat
