#include "core/hierarchy/level_faults.h"

#include <algorithm>
#include <array>

namespace pleat {
namespace {

/// Twice the area, along the normal.
Vec3 area_vector(const Positions& x, const Triangle& t) {
  const Vec3 x0 = x.col(t[0]);
  return (Vec3(x.col(t[1])) - x0).cross(Vec3(x.col(t[2])) - x0);
}

double longest_side(const Positions& x, const Triangle& t) {
  return std::max({(x.col(t[1]) - x.col(t[0])).norm(), (x.col(t[2]) - x.col(t[1])).norm(),
                   (x.col(t[0]) - x.col(t[2])).norm()});
}

/// Unit normals of vertices, the mean of their triangles' by area.
Positions vertex_normals(const TriangleMesh& mesh) {
  Positions normals = Positions::Zero(3, mesh.n_vertices());
  for (const Triangle& t : mesh.triangles)
    for (const VertexId v : t) normals.col(v) += area_vector(mesh.rest_positions, t);
  normals.colwise().normalize();
  return normals;
}

/// An edge of each triangle, the lower end first; what triangles share comes more than once.
std::vector<std::array<VertexId, 2>> sorted_sides(const std::vector<Triangle>& triangles) {
  std::vector<std::array<VertexId, 2>> sides;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k)
      sides.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
  std::sort(sides.begin(), sides.end());
  return sides;
}

}  // namespace

LevelFaults level_faults(const MeshLevel& level, const TriangleMesh& finest) {
  constexpr double kSlimmest = 1e-3;  // threshold of the guard: slimmer triangles have no direction
  LevelFaults faults;
  const Positions places = positions_on(level, finest.rest_positions);
  const Positions normals = positions_on(level, vertex_normals(finest));
  double covered = 0, whole = 0;
  for (const Triangle& t : finest.triangles) whole += area_vector(finest.rest_positions, t).norm();
  for (const Triangle& t : level.triangles) {
    const Vec3 area = area_vector(places, t);
    const Vec3 outwards = normals.col(t[0]) + normals.col(t[1]) + normals.col(t[2]);
    const bool looks_against = area.dot(outwards) < 0;
    const double longest = longest_side(places, t);
    if (looks_against || area.norm() < kSlimmest * longest * longest) ++faults.turned_triangles;
    covered += looks_against ? -area.norm() : area.norm();
  }
  if (whole > 0) faults.covered_share = covered / whole;

  std::vector<bool> is_border(static_cast<std::size_t>(finest.n_vertices()), false);
  for (const MeshEdge& edge : mesh_edges(finest.triangles))
    if (edge.is_border()) is_border[edge.a] = is_border[edge.b] = true;
  const auto sides = sorted_sides(level.triangles);
  for (auto side = sides.begin(); side != sides.end();) {
    const auto next = std::upper_bound(side, sides.end(), *side);
    const auto n_triangles = next - side;
    const auto& [a, b] = *side;
    if (n_triangles > 2) ++faults.crowded_edges;
    if (n_triangles == 1 && !(is_border[level.vertices[a]] && is_border[level.vertices[b]]))
      ++faults.strayed_borders;
    side = next;
  }
  return faults;
}

}  // namespace pleat
