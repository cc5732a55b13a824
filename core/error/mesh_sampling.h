#pragma once

#include <optional>

#include "core/error/material_map.h"
#include "core/mesh/quad_mesh.h"
#include "core/refinement/mesh_match.h"

namespace pleat {

/// Error of a shape that is shown on another mesh.
struct SamplingError {
  double distance = 0;      ///< root mean square over the cloth, between the same points [m]
  double normal_angle = 0;  ///< root mean square over the cloth, between normals [rad]
};

/// Shows shapes of a fine mesh on another mesh of the same cloth, whose vertices are where the same
/// points of the fine one are, hanging ones in the middle of their parents, and whose faces are
/// bilinear patches. Nothing moves: what is lost is the mesh's fault alone.
///
/// Where the fine mesh refines the other one, the same points are the same vertices; else they are
/// the nearest places at rest (MaterialMap), on triangles and cells that are split until they are
/// no larger than the fine mesh's.
class MeshSampling {
 public:
  /// Both are of one cloth at rest.
  MeshSampling(const QuadMesh& mesh, const QuadMesh& fine);

  /// Places [m], or velocities, of the mesh's vertices, from the fine ones.
  Positions sampled(const PositionsView& fine_columns) const;

  /// Places of the fine mesh's vertices when the mesh's are at these places [m].
  Positions shown(const PositionsView& columns) const;

  /// Error between a fine shape and the mesh at the same points when its vertices are at `columns`
  /// [m]. By rest area; a normal is the fine triangle's, against the mesh's own facet there: one
  /// through points on several facets would be smoother than what is seen.
  SamplingError error(const PositionsView& fine_positions, const PositionsView& columns) const;

  /// Error between a fine shape and its own sample.
  SamplingError error(const PositionsView& fine_positions) const {
    return error(fine_positions, sampled(fine_positions));
  }

 private:
  QuadMesh mesh_;
  QuadMesh fine_;
  Eigen::VectorXd areas_;             // rest areas of the fine vertices [m^2]
  std::vector<Triangle> triangles_;   // triangles of the fine mesh
  std::optional<MeshSample> sample_;  // set where the fine mesh refines the other
  std::optional<MaterialMap> to_mesh_;
  std::vector<HangingVertex> hanging_;
  QuadMesh cut_;  // the mesh in cells no larger than the fine one's
  std::optional<MaterialMap> to_fine_;
  std::optional<MaterialMap> to_facets_;  // points in the middles of the fine triangles
};

}  // namespace pleat
