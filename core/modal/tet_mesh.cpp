#include "core/modal/tet_mesh.h"

#include <algorithm>

#include "core/base/joined_sets.h"

namespace pleat {
namespace {

struct TetFace {
  std::array<int, 3> corners;  // ascending
  int tet;
  bool operator<(const TetFace& other) const { return corners < other.corners; }
};

}  // namespace

Mat3 tet_edges(const Positions& positions, const Tet& tet) {
  Mat3 edges;
  for (int k = 0; k < 3; ++k)
    edges.col(k) = positions.col(tet[static_cast<std::size_t>(k) + 1]) - positions.col(tet[0]);
  return edges;
}

double tet_volume(const Positions& positions, const Tet& tet) {
  return tet_edges(positions, tet).determinant() / 6;
}

double total_volume(const TetMesh& mesh, const Positions& positions) {
  double volume = 0;
  for (const Tet& tet : mesh.tets) volume += tet_volume(positions, tet);
  return volume;
}

Eigen::VectorXd vertex_volumes(const TetMesh& mesh) {
  Eigen::VectorXd volumes = Eigen::VectorXd::Zero(mesh.n_vertices());
  for (const Tet& tet : mesh.tets) {
    const double quarter = tet_volume(mesh.rest_positions, tet) / 4;
    for (const VertexId corner : tet) volumes[corner] += quarter;
  }
  return volumes;
}

std::vector<int> parts_by_faces(const TetMesh& mesh) {
  std::vector<TetFace> faces;
  faces.reserve(4 * mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      TetFace face{{}, static_cast<int>(t)};
      for (std::size_t k = 0; k < 3; ++k) face.corners[k] = mesh.tets[t][(left_out + 1 + k) % 4];
      std::sort(face.corners.begin(), face.corners.end());
      faces.push_back(face);
    }
  std::sort(faces.begin(), faces.end());
  JoinedSets sets(mesh.tets.size());
  for (std::size_t f = 1; f < faces.size(); ++f)
    if (faces[f].corners == faces[f - 1].corners) sets.join(faces[f].tet, faces[f - 1].tet);
  return sets.numbers();
}

bool hangs_together_by_faces(const TetMesh& mesh) {
  const auto n_parts = [](const std::vector<int>& parts) {
    return parts.empty() ? 0 : *std::max_element(parts.begin(), parts.end()) + 1;
  };
  return n_parts(parts_by_faces(mesh)) == n_parts(parts_by_vertices(mesh));
}

std::vector<int> parts_by_vertices(const TetMesh& mesh) {
  JoinedSets sets(static_cast<std::size_t>(mesh.n_vertices()));
  for (const Tet& tet : mesh.tets)
    for (std::size_t k = 1; k < 4; ++k) sets.join(tet[0], tet[k]);
  return sets.numbers();
}

}  // namespace pleat
