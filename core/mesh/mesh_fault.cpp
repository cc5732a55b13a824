#include "core/mesh/mesh_fault.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace pleat {
namespace {

/// A triangle's side, from one corner to the next.
struct Side {
  VertexId from, to, across;
  FaceId triangle;

  std::pair<int, int> edge() const { return std::minmax(from.value, to.value); }
};

/// Height over the longest side. Files often carry six digits: the height of a triangle that is
/// slimmer, and with it where the triangle faces, is rounding.
bool has_area(const Vec3& x0, const Vec3& x1, const Vec3& x2) {
  constexpr double kSlimmest = 1e-6;
  const Vec3 sides[] = {x1 - x0, x2 - x1, x0 - x2};
  double longest = 0;
  for (const Vec3& side : sides) longest = std::max(longest, side.squaredNorm());
  return sides[0].cross(sides[2]).norm() > kSlimmest * longest;
}

/// The fault of the side `later`, whose edge sides before it in `group` have too; empty when sound.
std::string side_fault(const Side* group, const Side* later, int first_vertex) {
  const auto number = [&](VertexId v) { return std::to_string(v.value + first_vertex); };
  const std::string ends = number(later->from) + " to " + number(later->to);
  if (later - group > 1)
    return "expected at most two triangles at an edge, got a third at that from vertex " + ends;
  if (later->from == group->from)
    return "expected neighbours wound alike, got two triangles that both go from vertex " + ends;
  if (later->across == group->across)
    return "expected each triangle once, got two with the vertices " + number(later->from) + ", " +
           number(later->to) + " and " + number(later->across);
  return "";
}

std::vector<Side> sides_by_edge(const std::vector<Triangle>& triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      sides.push_back({triangles[f][k], triangles[f][(k + 1) % 3], triangles[f][(k + 2) % 3],
                       FaceId(static_cast<std::int64_t>(f))});
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tuple(a.edge(), a.triangle.value) < std::tuple(b.edge(), b.triangle.value);
  });
  return sides;
}

std::optional<MeshFault> first_without_area(const PositionsView& positions,
                                            const std::vector<Triangle>& triangles,
                                            int first_vertex) {
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const auto& [v0, v1, v2] = triangles[f];
    if (has_area(positions.col(v0), positions.col(v1), positions.col(v2))) continue;
    const auto number = [&](VertexId v) { return std::to_string(v.value + first_vertex); };
    return MeshFault{FaceId(static_cast<std::int64_t>(f)), VertexId(),
                     "expected a triangle with an area, got the vertices " + number(v0) + ", " +
                         number(v1) + " and " + number(v2) + " on a line"};
  }
  return std::nullopt;
}

std::optional<MeshFault> first_at_an_edge(const std::vector<Triangle>& triangles,
                                          int first_vertex) {
  std::optional<MeshFault> first;
  const std::vector<Side> sides = sides_by_edge(triangles);
  const Side* group = sides.data();  // the sides of one edge begin here
  for (const Side& side : sides) {
    if (side.edge() != group->edge()) group = &side;
    if (&side == group || (first && first->triangle <= side.triangle)) continue;
    std::string sentence = side_fault(group, &side, first_vertex);
    if (!sentence.empty()) first = MeshFault{side.triangle, VertexId(), std::move(sentence)};
  }
  return first;
}

std::optional<MeshFault> first_lonely_vertex(Eigen::Index n_vertices,
                                             const std::vector<Triangle>& triangles,
                                             int first_vertex) {
  std::vector<bool> is_used(static_cast<std::size_t>(n_vertices), false);
  for (const Triangle& triangle : triangles)
    for (const VertexId v : triangle) is_used[v] = true;
  const auto lonely = std::find(is_used.begin(), is_used.end(), false);
  if (lonely == is_used.end()) return std::nullopt;
  const VertexId vertex(lonely - is_used.begin());
  return MeshFault{FaceId(), vertex,
                   "expected every vertex in a triangle, got vertex " +
                       std::to_string(vertex.value + first_vertex) + " in none"};
}

}  // namespace

std::optional<MeshFault> mesh_fault(const PositionsView& positions,
                                    const std::vector<Triangle>& triangles, int first_vertex) {
  if (auto fault = first_without_area(positions, triangles, first_vertex)) return fault;
  if (auto fault = first_at_an_edge(triangles, first_vertex)) return fault;
  return first_lonely_vertex(positions.cols(), triangles, first_vertex);
}

}  // namespace pleat
