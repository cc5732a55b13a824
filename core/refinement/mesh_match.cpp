#include "core/refinement/mesh_match.h"

#include <cmath>

#include "core/base/check.h"

namespace pleat {
namespace {

/// A grid on whose borders neither binary nor decimal fractions of a metre fall, so that a last bit
/// does not matter [1/m].
constexpr double kPerMetre = 1 << 20;

/// Fowler, Noll & Vo's hash, variant 1a.
class Fnv {
 public:
  void add(std::int64_t number) {
    auto bits = static_cast<std::uint64_t>(number);
    for (int byte = 0; byte < 8; ++byte, bits >>= 8) {
      hash_ ^= bits & 0xff;
      hash_ *= 0x100000001b3ULL;
    }
  }
  std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

void fill_mean(const VertexParents& parents, Eigen::Index v, Eigen::MatrixXd& values) {
  values.col(v).setZero();
  for (int k = 0; k < parents.count; ++k) values.col(v) += values.col(parents.vertices[k]);
  values.col(v) /= parents.count;
}

}  // namespace

std::uint64_t base_fingerprint(const QuadMesh& mesh) {
  Fnv fnv;
  for (const QuadFace& face : mesh.faces().first(static_cast<std::size_t>(mesh.n_base_faces())))
    for (const VertexId v : face.corners) fnv.add(v);
  for (int v = 0; v < mesh.n_vertices() && mesh.parents()[v].count == 0; ++v)
    for (const double x : mesh.rest_positions().col(v)) fnv.add(std::llround(x * kPerMetre));
  return fnv.hash();
}

std::vector<FaceId> matching_faces(const QuadMesh& mesh, const QuadMesh& finer) {
  PLEAT_CHECK(mesh.n_base_faces() == finer.n_base_faces(), "both meshes have the same base");
  std::vector<FaceId> matching(mesh.faces().size());
  for (int f = 0; f < mesh.n_base_faces(); ++f) matching[f] = FaceId(f);
  for (std::size_t f = 0; f < matching.size(); ++f) {  // children come after their parent
    const QuadFace& face = mesh.faces()[f];
    if (face.active()) continue;
    const QuadFace& same = finer.faces()[matching[f]];
    PLEAT_CHECK(!same.active(), "the finer mesh has every split of the other");
    for (int k = 0; k < 4; ++k) matching[face.children[k]] = same.children[k];
  }
  return matching;
}

std::vector<VertexId> matching_vertices(const QuadMesh& mesh, const QuadMesh& finer) {
  const std::vector<FaceId> faces = matching_faces(mesh, finer);
  std::vector<VertexId> matching(static_cast<std::size_t>(mesh.n_vertices()));
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (int k = 0; k < 4; ++k)
      matching[mesh.faces()[f].corners[k]] = finer.faces()[faces[f]].corners[k];
  return matching;
}

Eigen::MatrixXd continued(const Eigen::Ref<const Eigen::MatrixXd>& values, const QuadMesh& mesh) {
  Eigen::MatrixXd all(values.rows(), mesh.n_vertices());
  all.leftCols(values.cols()) = values;
  for (Eigen::Index v = values.cols(); v < all.cols(); ++v) fill_mean(mesh.parents()[v], v, all);
  return all;
}

Eigen::MatrixXd on_finer_mesh(const Eigen::Ref<const Eigen::MatrixXd>& values, const QuadMesh& mesh,
                              const QuadMesh& finer) {
  PLEAT_CHECK(values.cols() == mesh.n_vertices(), "one column per vertex");
  Eigen::MatrixXd all(values.rows(), finer.n_vertices());
  std::vector<bool> is_known(static_cast<std::size_t>(finer.n_vertices()), false);
  const std::vector<VertexId> matching = matching_vertices(mesh, finer);
  for (std::size_t v = 0; v < matching.size(); ++v) {
    all.col(matching[v]) = values.col(static_cast<Eigen::Index>(v));
    is_known[matching[v]] = true;
  }
  for (Eigen::Index v = 0; v < all.cols(); ++v)
    if (!is_known[v]) fill_mean(finer.parents()[v], v, all);
  return all;
}

void straighten(std::span<const HangingVertex> hanging, Positions& columns) {
  for (const HangingVertex& h : hanging)
    columns.col(h.vertex) = (columns.col(h.parents[0]) + columns.col(h.parents[1])) / 2;
}

Positions MeshSample::of(const PositionsView& finer_columns) const {
  Positions columns(3, static_cast<Eigen::Index>(vertices_.size()));
  for (std::size_t v = 0; v < vertices_.size(); ++v)
    columns.col(static_cast<Eigen::Index>(v)) = finer_columns.col(vertices_[v]);
  straighten(hanging_, columns);
  return columns;
}

}  // namespace pleat
