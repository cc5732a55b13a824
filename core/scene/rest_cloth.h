#pragma once

#include <optional>
#include <vector>

#include "core/scene/scene.h"

namespace pleat {

/// The cloth of a scene before it moves.
struct RestCloth {
  std::optional<QuadMesh> quads;     ///< of a sheet or garment
  TriangleMesh mesh;                 ///< of any cloth; of particles without warp directions
  std::vector<VertexGroup> groups;   ///< of a mesh or garment
  RestCoordinates rest_coordinates;  ///< 2 x n [m], or empty: of a mesh, texture coordinates
  Positions start;                   ///< where it begins [m]: at rest, a garment as it is round
};

/// The unrefined quads of a sheet or garment; none of other cloth.
std::optional<QuadMesh> base_quads(const Scene& scene);

/// As the scene refines it, by its plan or level.
RestCloth rest_cloth(const Scene& scene);

/// Refined uniformly, to a level that check_level lets pass.
RestCloth rest_cloth(const Scene& scene, int level);

/// On quads that refine its base in any way.
RestCloth rest_cloth(const Scene& scene, QuadMesh quads);

/// Rest area of each vertex [m^2]; particles count by their mass.
Eigen::VectorXd rest_areas(const Scene& scene, const RestCloth& cloth);

/// Length that position errors are given in per cent of [m]: a sheet's diagonal, or that of the box
/// around a mesh or particles. 0 for a single particle.
double rest_diagonal(const Scene& scene);

/// The vertices that a rule pins, ascending unless the scene lists them.
std::vector<VertexId> pinned_vertices(const PinRule& rule, const Scene& scene,
                                      const RestCloth& cloth);

}  // namespace pleat
