#include "core/mesh/triangle_mesh.h"

#include <algorithm>
#include <unordered_map>

#include "core/base/check.h"
#include "core/mesh/edge_key.h"

namespace pleat {
namespace {

/// Middles of edges, made on first use.
class EdgeMiddles {
 public:
  explicit EdgeMiddles(int n_vertices) : n_vertices_(n_vertices) {}

  VertexId of(VertexId a, VertexId b) {
    const auto [place, is_new] = middles_.try_emplace(
        edge_key(a, b), VertexId(n_vertices_ + static_cast<int>(ends_.size())));
    if (is_new) ends_.push_back({a, b});
    return place->second;
  }
  const std::vector<std::array<VertexId, 2>>& ends() const { return ends_; }

 private:
  int n_vertices_;
  std::vector<std::array<VertexId, 2>> ends_;
  std::unordered_map<std::uint64_t, VertexId> middles_;  // only looked up, never walked
};

/// The four parts of a triangle, whose corners come first and then the middles of the sides 01, 12
/// and 20.
constexpr std::array<std::array<std::size_t, 3>, 4> kParts{
    {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};

void add_pattern_of_parts(const CornerTexture& whole, std::vector<CornerTexture>& pattern) {
  Eigen::Matrix<double, 2, 6> places;
  places << whole, (whole.col(0) + whole.col(1)) / 2, (whole.col(1) + whole.col(2)) / 2,
      (whole.col(2) + whole.col(0)) / 2;
  for (const auto& part : kParts) {
    CornerTexture& corners = pattern.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      corners.col(static_cast<Eigen::Index>(k)) = places.col(static_cast<Eigen::Index>(part[k]));
  }
}

TriangleMesh subdivided_once(const TriangleMesh& mesh,
                             std::vector<std::array<VertexId, 2>>* middles) {
  EdgeMiddles edges(mesh.n_vertices());
  TriangleMesh fine;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto& [v0, v1, v2] = mesh.triangles[f];
    const VertexId m01 = edges.of(v0, v1);
    const VertexId m12 = edges.of(v1, v2);
    const std::array<VertexId, 6> vertices{v0, v1, v2, m01, m12, edges.of(v2, v0)};
    for (const auto& part : kParts)
      fine.triangles.push_back({vertices[part[0]], vertices[part[1]], vertices[part[2]]});
    if (!mesh.pattern.empty()) add_pattern_of_parts(mesh.pattern[f], fine.pattern);
    fine.warp_directions.insert(fine.warp_directions.end(), 4, mesh.warp_directions[f]);
  }
  const Eigen::Index n = mesh.n_vertices();
  fine.rest_positions.resize(3, n + static_cast<Eigen::Index>(edges.ends().size()));
  fine.rest_positions.leftCols(n) = mesh.rest_positions;
  Eigen::Index column = n;
  for (const auto& [a, b] : edges.ends())
    fine.rest_positions.col(column++) =
        (mesh.rest_positions.col(a) + mesh.rest_positions.col(b)) / 2;
  if (middles != nullptr) middles->insert(middles->end(), edges.ends().begin(), edges.ends().end());
  return fine;
}

}  // namespace

std::vector<MeshEdge> mesh_edges(const std::vector<Triangle>& triangles) {
  std::vector<MeshEdge> edges;
  std::unordered_map<std::uint64_t, std::size_t> known;  // only looked up, never walked
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const FaceId face(static_cast<std::int64_t>(f));
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = triangles[f][k];
      const VertexId b = triangles[f][(k + 1) % 3];
      const VertexId across = triangles[f][(k + 2) % 3];
      const auto [place, is_new] = known.try_emplace(edge_key(a, b), edges.size());
      if (is_new) {
        edges.push_back({a, b, {face, FaceId()}, {across, VertexId()}});
        continue;
      }
      MeshEdge& edge = edges[place->second];
      PLEAT_CHECK(edge.is_border(), "at most two triangles meet at an edge");
      edge.faces[1] = face;
      edge.across[1] = across;
    }
  }
  return edges;
}

CornerTexture flat_corners(const TriangleMesh& mesh, FaceId face) {
  if (!mesh.pattern.empty())
    return mesh.pattern[face].colwise() - Eigen::Vector2d(mesh.pattern[face].col(0));
  const Positions& x = mesh.rest_positions;
  const Triangle& t = mesh.triangles[face];
  Mat3 arms;
  arms << Vec3::Zero(), x.col(t[1]) - x.col(t[0]), x.col(t[2]) - x.col(t[0]);
  const Vec3& warp = mesh.warp_directions[face];
  Eigen::Matrix<double, 3, 2> threads;
  threads << warp, arms.col(1).cross(arms.col(2)).normalized().cross(warp);
  return threads.transpose() * arms;
}

double rest_area(const TriangleMesh& mesh, FaceId face) {
  if (!mesh.pattern.empty()) {
    const CornerTexture flat = flat_corners(mesh, face);
    return (flat(0, 1) * flat(1, 2) - flat(1, 1) * flat(0, 2)) / 2;
  }
  const Positions& x = mesh.rest_positions;
  const Triangle& t = mesh.triangles[face];
  return Vec3(x.col(t[1]) - x.col(t[0])).cross(Vec3(x.col(t[2]) - x.col(t[0]))).norm() / 2;
}

double rest_length(const TriangleMesh& mesh, const MeshEdge& edge) {
  if (mesh.pattern.empty())
    return (mesh.rest_positions.col(edge.a) - mesh.rest_positions.col(edge.b)).norm();
  double sum = 0;
  const std::size_t n_sides = edge.is_border() ? 1 : 2;
  for (std::size_t side = 0; side < n_sides; ++side) {
    const Triangle& t = mesh.triangles[edge.faces[side]];
    const auto a = std::find(t.begin(), t.end(), edge.a) - t.begin();
    const auto b = std::find(t.begin(), t.end(), edge.b) - t.begin();
    const CornerTexture& flat = mesh.pattern[edge.faces[side]];
    sum += (flat.col(a) - flat.col(b)).norm();
  }
  return sum / static_cast<double>(n_sides);
}

Eigen::VectorXd vertex_areas(const TriangleMesh& mesh) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(mesh.n_vertices());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const double area = rest_area(mesh, FaceId(static_cast<std::int64_t>(f)));
    for (const VertexId v : mesh.triangles[f]) areas[v] += area / 3;
  }
  return areas;
}

Vec3 direction_in_plane(const Vec3& direction, const Vec3& x0, const Vec3& x1, const Vec3& x2) {
  constexpr double kPerpendicular = 1e-6;  // sine; such a direction says nothing about the plane
  const Vec3 doubled_area = (x1 - x0).cross(x2 - x0);
  if (doubled_area.isZero(0)) return Vec3::Zero();
  const Vec3 normal = doubled_area.normalized();
  const Vec3 along = direction - normal.dot(direction) * normal;
  if (along.norm() <= kPerpendicular * direction.norm()) return Vec3::Zero();
  return along.normalized();
}

TriangleMesh subdivided(TriangleMesh mesh, int levels,
                        std::vector<std::array<VertexId, 2>>* middles) {
  PLEAT_CHECK(levels >= 0, "a mesh is split so many times or not at all");
  for (int level = 0; level < levels; ++level) mesh = subdivided_once(mesh, middles);
  return mesh;
}

}  // namespace pleat
