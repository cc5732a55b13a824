#pragma once

#include <cmath>
#include <optional>

#include "core/modal/reduced_arap.h"
#include "core/modal/surface_detail.h"
#include "core/modal/volume_fit.h"

namespace pleat {

enum class VolumeKind { lattice, shell };

struct ModalOptions {
  std::optional<VolumeKind> volume;  ///< default: lattice for closed surfaces, shell for open ones
  double size = 0;  ///< edge of the lattice or thickness of the shell [m]; 0 for the usual
  int n_modes = 0;  ///< number for each key, beside the rigid ones; 0: 40, or all that there are
  int n_functions = 64;      ///< size of the space
  int n_clusters = 64;       ///< number of clusters of tetrahedra
  bool exact_keys = false;   ///< adds the keys to the space
  double detail_beyond = 0;  ///< patches nearer to the space have no detail [m]
};

/// The kind that the options name, or the usual one for these triangles.
VolumeKind volume_kind(const std::vector<Triangle>& triangles, const ModalOptions& options);

/// The volume of a surface that hangs together, and the shapes it takes.
///
/// Usual sizes: the lattice's edge is such that 4000 cubes have the surface's volume; the shell is
/// as thick as the mean edge is long.
CarryingVolume carrying_volume(const Positions& surface, const std::vector<Triangle>& triangles,
                               const ModalOptions& options);

/// The volume at each key: the first one's as it is, then fitted to the others one after another,
/// so that surface and volume may go far. Throws InputError where a fit fails.
std::vector<Positions> key_volumes(const CarryingVolume& carrying, const VolumeFit& fit,
                                   const std::vector<Positions>& keys);
/// A fit that brings the surface to a hundredth of what the volume resists.
VolumeFit usual_fit(const CarryingVolume& carrying);

/// True where every edge has two triangles.
bool is_closed(const std::vector<Triangle>& triangles);

/// The lowest modes of a volume as it lies, under the energy and masses of 1 Pa and 1 kg/m^3, those
/// of its parts' rigid motions first; 0 for as many as is usual. Throws InputError where it has
/// fewer than are asked for.
SolveReport volume_modes(const TetMesh& rest, int count, Modes& modes);

/// A surface in one part, its key shapes, and the space of shapes that they span.
///
/// Its first key is the reference: its volume's weights measure all distances.
class ModalBody {
 public:
  /// Precomputes: a volume and its modes for each key, the space, its clusters.
  ///
  /// keys       surfaces with the same vertices, one or more [m]
  /// triangles  of all of them
  ///
  /// Throws InputError where no volume can carry a key.
  ModalBody(const std::vector<Positions>& keys, const std::vector<Triangle>& triangles,
            const ModalOptions& options);

  /// A shape between two keys.
  struct Shape {
    ReducedArap::Key key;
    ArapBlend::Distances distances{0, 0};  ///< distances from its neighbours when it was made
    bool converged = true;
  };

  int n_keys() const { return static_cast<int>(keys_.size()); }
  const Shape& key(int index) const { return keys_[static_cast<std::size_t>(index)].shape; }
  /// Another surface for a key; modes and space stay.
  SolveReport replace_key(int index, const Positions& surface);

  /// Half way, as a whole too (turn_half_way, shift_half_way).
  Shape middle(const Shape& a, const Shape& b) const;
  /// How far apart two shapes are, as the root of the mean square over the volume [m].
  double distance(const Shape& a, const Shape& b) const {
    return (a.key.shape - b.key.shape).norm() / std::sqrt(space_.masses.sum());
  }
  /// The surface of a shape that lies between key `left` and the next one, with so much of the
  /// detail of that next one; a key's own surface to rounding.
  Positions surface(const Shape& shape, int left, double share_of_next) const;
  Positions volume_positions(const Shape& shape) const { return space_.positions(shape.key.shape); }

  const CarryingVolume& carrying() const { return carrying_; }
  const ShapeSpace& space() const { return space_; }
  const ReducedArap& arap() const { return *arap_; }
  const std::vector<int>& cluster_of_tet() const { return cluster_of_tet_; }
  const std::vector<Modes>& modes() const { return modes_; }  ///< modes of each key's volume

 private:
  struct Key {
    Positions volume;
    Positions residual;  // part of the surface that the space does not have
    Shape shape;
  };

  void take(Key& key, const Positions& surface) const;

  CarryingVolume carrying_;
  double detail_beyond_;
  VolumeFit fit_;
  std::vector<Modes> modes_;
  ShapeSpace space_;
  std::vector<int> cluster_of_tet_;
  std::unique_ptr<ReducedArap> arap_;
  std::unique_ptr<SurfaceDetail> detail_;
  Eigen::MatrixXd surface_functions_;  // k x vertices of the surface
  Eigen::MatrixXd points_;             // columns of points that are spread over it
  std::vector<Key> keys_;
};

}  // namespace pleat
