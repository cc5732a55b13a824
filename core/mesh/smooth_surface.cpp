#include "core/mesh/smooth_surface.h"

#include <array>
#include <map>
#include <optional>
#include <utility>

#include "core/base/check.h"
#include "core/mesh/mesh_lines.h"

namespace pleat {
namespace {

/// Lines that turn by more than 60 degrees end there, as between a garment's legs.
constexpr double kLeastCosine = 0.5;

/// The vertex from which a line comes to an edge, by the edge's ends in order.
using LinesBefore = std::map<std::pair<int, int>, VertexId>;

LinesBefore lines_before(const QuadMesh& base) {
  const Positions& x = base.rest_positions();
  LinesBefore before;
  for (const LineChord& chord : line_chords(base, thread_edges(base))) {
    const Vec3 back = x.col(chord.middle) - x.col(chord.before);
    const Vec3 ahead = x.col(chord.after) - x.col(chord.middle);
    if (back.dot(ahead) < kLeastCosine * back.norm() * ahead.norm()) continue;
    before[{chord.middle.value, chord.after.value}] = chord.before;
    before[{chord.middle.value, chord.before.value}] = chord.after;
  }
  return before;
}

/// The smooth surface of a base mesh.
class SmoothSurface {
 public:
  explicit SmoothSurface(const QuadMesh& base) : base_(base), before_(lines_before(base)) {}

  /// s from corner 0 to 1, t from corner 0 to 3, both in [0, 1].
  Vec3 at(const QuadFace& face, const Eigen::Vector2d& place) const {
    const auto& c = face.corners;
    const double s = place.x();
    const double t = place.y();
    const Vec3 along_s = (1 - t) * on_edge(c[0], c[1], s) + t * on_edge(c[3], c[2], s);
    const Vec3 along_t = (1 - s) * on_edge(c[0], c[3], t) + s * on_edge(c[1], c[2], t);
    const Vec3 of_corners = (1 - t) * ((1 - s) * position(c[0]) + s * position(c[1])) +
                            t * ((1 - s) * position(c[3]) + s * position(c[2]));
    return along_s + along_t - of_corners;
  }

 private:
  Vec3 position(VertexId vertex) const { return base_.rest_positions().col(vertex); }

  /// Has the length of the edge; none where a line begins with the edge.
  std::optional<Vec3> tangent(VertexId a, VertexId b) const {
    const auto found = before_.find({a.value, b.value});
    if (found == before_.end()) return std::nullopt;
    const Vec3 back = position(a) - position(found->second);
    const Vec3 ahead = position(b) - position(a);
    const double l = back.norm();
    const double m = ahead.norm();
    // The circle through three points has the tangent back / l^2 + ahead / m^2 in the middle one.
    return m * (m * m * back + l * l * ahead).normalized();
  }

  Vec3 on_edge(VertexId a, VertexId b, double s) const {
    const Vec3 chord = position(b) - position(a);
    std::optional<Vec3> at_a = tangent(a, b);
    std::optional<Vec3> at_b = tangent(b, a);
    if (at_b) at_b = -*at_b;
    if (!at_a && !at_b) return position(a) + s * chord;
    if (!at_a) at_a = (3 * chord - *at_b) / 2;
    if (!at_b) at_b = (3 * chord - *at_a) / 2;
    return position(a) + s * s * (3 - 2 * s) * chord + s * (1 - s) * (1 - s) * *at_a -
           s * s * (1 - s) * *at_b;
  }

  const QuadMesh& base_;
  LinesBefore before_;
};

using CornerPlaces = std::array<Eigen::Vector2d, 4>;

void place_corners(const QuadMesh& mesh, const QuadFace& face, const CornerPlaces& places,
                   const SmoothSurface& surface, const QuadFace& root, Positions& positions) {
  if (face.active()) {
    for (std::size_t k = 0; k < 4; ++k)
      positions.col(face.corners[k]) = surface.at(root, places[k]);
    return;
  }
  for (std::size_t k = 0; k < 4; ++k) {
    CornerPlaces child;
    for (std::size_t j = 0; j < 4; ++j) child[j] = (places[k] + places[j]) / 2;
    place_corners(mesh, mesh.faces()[face.children[k]], child, surface, root, positions);
  }
}

}  // namespace

Positions on_smooth_surface(const QuadMesh& base, const QuadMesh& refined) {
  PLEAT_CHECK(static_cast<int>(base.faces().size()) == refined.n_base_faces() &&
                  base.n_vertices() <= refined.n_vertices(),
              "a mesh refines its own base");
  const SmoothSurface surface(base);
  Positions positions = refined.rest_positions();
  const CornerPlaces square = {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(1, 1),
                               Eigen::Vector2d(0, 1)};
  for (int f = 0; f < refined.n_base_faces(); ++f) {
    const QuadFace& root = refined.faces()[static_cast<std::size_t>(f)];
    place_corners(refined, root, square, surface, root, positions);
  }
  positions.leftCols(base.n_vertices()) = base.rest_positions();
  for (const HangingVertex& h : refined.hanging_vertices())
    positions.col(h.vertex) = (positions.col(h.parents[0]) + positions.col(h.parents[1])) / 2;
  return positions;
}

}  // namespace pleat
