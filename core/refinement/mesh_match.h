#pragma once

#include <cstdint>
#include <vector>

#include "core/mesh/quad_mesh.h"

namespace pleat {

/// Fingerprint of a base mesh, equal for all its refinements: FNV-1a over the base quads' corners
/// and the base vertices' rest positions, these to a micrometre.
std::uint64_t base_fingerprint(const QuadMesh& mesh);

/// The face of a finer mesh that covers the same cloth, for each face, split or not.
///
/// finer  a refinement of the same base in which every split of `mesh` was made too;
///        ContractError otherwise
std::vector<FaceId> matching_faces(const QuadMesh& mesh, const QuadMesh& finer);

/// Vertex of a finer mesh that is the same, for each vertex. Errors as above.
std::vector<VertexId> matching_vertices(const QuadMesh& mesh, const QuadMesh& finer);

/// Values at the first vertices of a mesh, a column each, continued to all of them: a later vertex
/// has the mean of its parents.
Eigen::MatrixXd continued(const Eigen::Ref<const Eigen::MatrixXd>& values, const QuadMesh& mesh);

/// Values at the vertices of a mesh, a column each, on a finer one: a vertex that only that has
/// gets the mean of its parents.
Eigen::MatrixXd on_finer_mesh(const Eigen::Ref<const Eigen::MatrixXd>& values, const QuadMesh& mesh,
                              const QuadMesh& finer);

/// Puts hanging vertices into the middle of their parents, a column each.
void straighten(std::span<const HangingVertex> hanging, Positions& columns);

/// Takes shapes of a finer mesh to a mesh, as far as it can show them.
class MeshSample {
 public:
  /// Errors as matching_vertices.
  MeshSample(const QuadMesh& mesh, const QuadMesh& finer)
      : vertices_(matching_vertices(mesh, finer)), hanging_(mesh.hanging_vertices()) {}

  /// The finer mesh's columns at this one's vertices, hanging ones in the middle of their parents.
  Positions of(const PositionsView& finer_columns) const;

 private:
  std::vector<VertexId> vertices_;
  std::vector<HangingVertex> hanging_;
};

}  // namespace pleat
