#include "core/contact/surface_crossings.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/mesh/triangle_boxes.h"

namespace pleat {
namespace {

using Edge = std::array<VertexId, 2>;

/// Six times the volume of a tetrahedron; 0 where rounding could have made its sign. Three products
/// of differences err by less than 16 u of the sum of their sizes, u = 2^-53.
double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 p = a - d;
  const Vec3 q = b - d;
  const Vec3 r = c - d;
  const double size = p.norm() * q.norm() * r.norm();
  const double volume = p.dot(q.cross(r));
  return std::abs(volume) > 0x1p-48 * size ? volume : 0;
}

bool same_sign(double a, double b) { return (a > 0 && b > 0) || (a < 0 && b < 0); }

/// The ends lie on either side of the plane, and the line passes all three borders on one side.
std::optional<Vec3> passing(const Vec3& from, const Vec3& to, const Corners& c) {
  const double below = volume(c[0], c[1], c[2], from);
  const double above = volume(c[0], c[1], c[2], to);
  if (!same_sign(below, -above)) return std::nullopt;
  const double first = volume(from, to, c[0], c[1]);
  if (!same_sign(first, volume(from, to, c[1], c[2])) ||
      !same_sign(first, volume(from, to, c[2], c[0])))
    return std::nullopt;
  return Vec3(from + below / (below - above) * (to - from));
}

std::vector<Edge> edges_of(const std::vector<Triangle>& triangles) {
  std::vector<Edge> edges;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge edge{t[k], t[(k + 1) % 3]};
      edges.push_back(edge[0] < edge[1] ? edge : Edge{edge[1], edge[0]});
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Calls found(triangle, place) for each triangle that a segment passes through.
template <class Found>
void for_each_passed(const TriangleBoxes& boxes, const std::vector<Corners>& corners,
                     const Vec3& from, const Vec3& to, std::vector<std::size_t>& open,
                     const Found& found) {
  Eigen::AlignedBox3d box(from);
  box.extend(to);
  open.assign(1, 0);
  while (!open.empty()) {
    const std::size_t index = open.back();
    open.pop_back();
    const TriangleBoxes::Node& node = boxes.nodes()[index];
    if (!node.box.intersects(box)) continue;
    if (!node.is_leaf()) {
      open.push_back(index + 1);
      open.push_back(node.second);
      continue;
    }
    for (std::size_t k = node.begin; k < node.end; ++k)
      if (const auto place = passing(from, to, corners[boxes.order()[k]]))
        found(boxes.order()[k], *place);
  }
}

/// is_left_out  of a face, whether an edge may pass it
template <class Rule>
std::vector<SurfaceCrossing> find(const PositionsView& edge_places, const std::vector<Edge>& edges,
                                  const PositionsView& face_places,
                                  const std::vector<Triangle>& faces, const Rule& is_left_out) {
  std::vector<SurfaceCrossing> all;
  if (faces.empty()) return all;
  const std::vector<Corners> corners = triangle_corners(faces, face_places);
  const TriangleBoxes boxes(corners);
  std::vector<std::size_t> open;
  for (const Edge& edge : edges)
    for_each_passed(boxes, corners, edge_places.col(edge[0]), edge_places.col(edge[1]), open,
                    [&](std::size_t face, const Vec3& place) {
                      if (!is_left_out(edge, faces[face]))
                        all.push_back({edge, static_cast<int>(face), place});
                    });
  return all;
}

}  // namespace

std::vector<SurfaceCrossing> crossings(const PositionsView& edge_places,
                                       const std::vector<Triangle>& triangles_with_edges,
                                       const PositionsView& face_places,
                                       const std::vector<Triangle>& faces) {
  return find(edge_places, edges_of(triangles_with_edges), face_places, faces,
              [](const Edge&, const Triangle&) { return false; });
}

std::vector<SurfaceCrossing> own_crossings(const PositionsView& places,
                                           const std::vector<Triangle>& triangles) {
  return find(
      places, edges_of(triangles), places, triangles, [](const Edge& edge, const Triangle& face) {
        return std::any_of(face.begin(), face.end(),
                           [&](VertexId corner) { return corner == edge[0] || corner == edge[1]; });
      });
}

}  // namespace pleat
