#include "core/deform/held_parts.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/base/check.h"

namespace pleat {
namespace {

/// The lowest triangle that each triangle hangs together with.
/// Source: Tarjan, Efficiency of a good but not linear set union algorithm, J. ACM 22, 1975.
std::vector<int> lowest_in_part(const TriangleMesh& mesh) {
  std::vector<int> parent(mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int f) {
    while (parent[f] != f) f = parent[f] = parent[parent[f]];
    return f;
  };
  for (const MeshEdge& edge : mesh_edges(mesh.triangles)) {
    if (edge.is_border()) continue;
    const int a = root(edge.faces[0]);
    const int b = root(edge.faces[1]);
    parent[std::max(a, b)] = std::min(a, b);
  }
  std::vector<int> lowest;
  for (std::size_t f = 0; f < parent.size(); ++f) lowest.push_back(root(static_cast<int>(f)));
  return lowest;
}

/// The place farthest from the first spans the line from which the others are measured; the size is
/// the part's at rest [m].
Hold hold_of(const std::vector<Vec3>& places, double size) {
  constexpr double kSame = 1e-6;  // share of the size; files often carry six digits
  constexpr double kLastDigits = 4 * std::numeric_limits<double>::epsilon();
  if (places.empty()) return Hold::none;
  Vec3 arm = Vec3::Zero();
  double reach = 0;  // distance from the origin
  for (const Vec3& place : places) {
    if ((place - places[0]).norm() > arm.norm()) arm = place - places[0];
    reach = std::max(reach, place.norm());
  }
  const double rounding = kLastDigits * reach;
  if (arm.norm() <= kSame * size + rounding) return Hold::point;
  const auto is_off = [&](const Vec3& place) {
    return (place - places[0]).cross(arm.normalized()).norm() > kSame * arm.norm() + rounding;
  };
  return std::any_of(places.begin(), places.end(), is_off) ? Hold::firm : Hold::line;
}

double size_of(const std::vector<VertexId>& part, const Positions& rest) {
  Positions places(3, static_cast<Eigen::Index>(part.size()));
  for (std::size_t k = 0; k < part.size(); ++k)
    places.col(static_cast<Eigen::Index>(k)) = rest.col(part[k]);
  return box_diagonal(places);
}

}  // namespace

std::vector<HeldPart> held_parts(const TriangleMesh& mesh, const std::vector<VertexId>& held,
                                 const PositionsView& targets) {
  PLEAT_CHECK(static_cast<Eigen::Index>(held.size()) == targets.cols(),
              "every held vertex has a place");
  std::vector<int> place_of(static_cast<std::size_t>(mesh.n_vertices()), -1);
  for (std::size_t k = 0; k < held.size(); ++k) place_of[held[k]] = static_cast<int>(k);
  const std::vector<int> lowest = lowest_in_part(mesh);
  std::vector<std::vector<VertexId>> vertices(mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (const VertexId v : mesh.triangles[f]) vertices[lowest[f]].push_back(v);
  std::vector<HeldPart> parts;
  for (std::vector<VertexId>& part : vertices) {
    if (part.empty()) continue;
    std::sort(part.begin(), part.end());
    part.erase(std::unique(part.begin(), part.end()), part.end());
    std::vector<Vec3> places;
    for (const VertexId v : part)
      if (place_of[v] >= 0) places.emplace_back(targets.col(place_of[v]));
    parts.push_back({part.front(), static_cast<int>(part.size()),
                     hold_of(places, size_of(part, mesh.rest_positions))});
  }
  std::sort(parts.begin(), parts.end(),
            [](const HeldPart& a, const HeldPart& b) { return a.first < b.first; });
  return parts;
}

}  // namespace pleat
