#include "core/mesh/triangle_mesh.h"

#include <algorithm>
#include <cstdint>
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

TriangleMesh subdivided_once(const TriangleMesh& mesh,
                             std::vector<std::array<VertexId, 2>>* middles) {
  EdgeMiddles edges(mesh.n_vertices());
  TriangleMesh fine;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto& [v0, v1, v2] = mesh.triangles[f];
    const VertexId m01 = edges.of(v0, v1);
    const VertexId m12 = edges.of(v1, v2);
    const VertexId m20 = edges.of(v2, v0);
    for (const Triangle& child : {Triangle{v0, m01, m20}, Triangle{m01, v1, m12},
                                  Triangle{m20, m12, v2}, Triangle{m01, m12, m20}})
      fine.triangles.push_back(child);
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

Eigen::VectorXd vertex_areas(const TriangleMesh& mesh) {
  const Positions& x = mesh.rest_positions;
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(mesh.n_vertices());
  for (const Triangle& t : mesh.triangles) {
    const Vec3 doubled_area = (x.col(t[1]) - x.col(t[0])).cross(x.col(t[2]) - x.col(t[0]));
    for (const VertexId v : t) areas[v] += doubled_area.norm() / 6;
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
