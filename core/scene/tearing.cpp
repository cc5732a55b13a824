#include "core/scene/tearing.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/check.h"
#include "core/base/joined_sets.h"
#include "core/mesh/cut_faces.h"
#include "core/scene/scene.h"

namespace pleat {
namespace {

CutFaces faces_of(const RestCloth& cloth) {
  std::vector<VertexId> corners;
  if (cloth.quads) {
    for (const QuadFace& face : cloth.quads->faces())
      if (face.active()) corners.insert(corners.end(), face.corners.begin(), face.corners.end());
  } else {
    for (const Triangle& triangle : cloth.mesh.triangles)
      corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  return {std::move(corners), cloth.quads ? 4 : 3, cloth.mesh.n_vertices()};
}

RestCloth with_faces(RestCloth cloth, const CutFaces& faces) {
  const std::vector<VertexId>& origins = faces.origins();
  if (cloth.quads) {
    cloth.quads->tear(faces.corners(), origins);
    cloth.mesh = cloth.quads->triangle_mesh();
    cloth.rest_coordinates = cloth.quads->rest_coordinates();
  } else {
    cloth.mesh.rest_positions = with_split(cloth.mesh.rest_positions, origins);
    if (cloth.rest_coordinates.cols() > 0)
      cloth.rest_coordinates = with_split(cloth.rest_coordinates, origins);
    auto corner = faces.corners().begin();
    for (Triangle& triangle : cloth.mesh.triangles)
      for (VertexId& vertex : triangle) vertex = *corner++;
  }
  cloth.start = with_split(cloth.start, origins);
  cloth.start_velocities = with_split(cloth.start_velocities, origins);
  return cloth;
}

struct Overload {
  const GaugeEdge* edge;
  double strain;
};

/// A cloth while it tears, at most once in a region: nobody asks for a face that has split.
class Tear {
 public:
  Tear(const RestCloth& cloth, std::span<const GaugeEdge> gauge, const Positions& positions,
       std::span<const Pin> pins)
      : rest_(cloth.mesh.rest_positions),
        positions_(positions),
        faces_(faces_of(cloth)),
        edges_at_(static_cast<std::size_t>(positions.cols())),
        is_held_(edges_at_.size()) {
    for (const GaugeEdge& edge : gauge)
      for (const VertexId end : {edge.a, edge.b}) edges_at_[end].push_back(&edge);
    for (const Pin& pin : pins) is_held_[pin.vertex] = 1;
  }

  /// Splits an end of the edge; false when none can.
  bool give_way(const GaugeEdge& edge) {
    std::array<VertexId, 2> ends{std::min(edge.a, edge.b), std::max(edge.a, edge.b)};
    if (strain_beyond(edge, ends[1]) > strain_beyond(edge, ends[0])) std::swap(ends[0], ends[1]);
    return split(edge, ends[0]) || split(edge, ends[1]);
  }

  /// Number of each vertex's region: ends of overloads that have faces in common, or that others
  /// join, with all corners of these faces.
  std::vector<int> regions(const std::vector<Overload>& overloads) const {
    JoinedSets joined(edges_at_.size());
    for (const Overload& overload : overloads)
      for (const VertexId end : {overload.edge->a, overload.edge->b})
        for (const FaceId face : faces_.faces_at(end))
          for (const VertexId corner : faces_.corners_of(face)) joined.join(end, corner);
    return joined.numbers();
  }

  const CutFaces& faces() const { return faces_; }

 private:
  /// The plane through an end of an edge, across it: at rest, unless both ends are at one place
  /// there.
  struct Plane {
    const Positions& shape;
    Vec3 place;
    Vec3 normal;  // vector to the other end, as long as the edge

    /// True for a point on the far side; the plane itself is on the edge's side.
    bool is_beyond(const Vec3& point) const {
      constexpr double kOnPlane = 1e-9;  // share of the edge: far above rounding, far below a face
      return normal.dot(point - place) < -kOnPlane * normal.squaredNorm();
    }
  };

  Plane plane_at(const GaugeEdge& edge, VertexId end) const {
    const VertexId other = end == edge.a ? edge.b : edge.a;
    const Positions& shape = rest_.col(end) == rest_.col(other) ? positions_ : rest_;
    return {shape, shape.col(end), shape.col(other) - shape.col(end)};
  }

  /// The largest strain of the edges at this end that lie beyond it; 0 without any.
  double strain_beyond(const GaugeEdge& edge, VertexId end) const {
    const Plane plane = plane_at(edge, end);
    double largest = 0;
    for (const GaugeEdge* other : edges_at_[end])
      if (plane.is_beyond(plane.shape.col(other->a == end ? other->b : other->a)))
        largest = std::max(largest, strain(*other, positions_));
    return largest;
  }

  bool split(const GaugeEdge& edge, VertexId end) {
    const Plane plane = plane_at(edge, end);
    std::vector<FaceId> beyond;
    for (const FaceId face : faces_.faces_at(end)) {
      Vec3 sum = Vec3::Zero();
      for (const VertexId corner : faces_.corners_of(face)) sum += plane.shape.col(corner);
      if (plane.is_beyond(sum / static_cast<double>(faces_.corners_of(face).size())))
        beyond.push_back(face);
    }
    return !faces_.cut(end, beyond, is_held_).empty();
  }

  const Positions& rest_;
  const Positions& positions_;
  CutFaces faces_;
  std::vector<std::vector<const GaugeEdge*>> edges_at_;
  std::vector<char> is_held_;
};

}  // namespace

Json json_tearing(const Tearing& tearing) {
  Json json;
  json["breaking_elongation"] = tearing.breaking_elongation;
  return json;
}

void check_tearing(const JsonReader& reader, const Scene& scene) {
  if (!scene.cloth->is_surface())
    reader.fail("no such key, as particles have no faces that could part");
  if (scene.plan) reader.fail("a uniform mesh, as hanging vertices do not split");
  if (scene.model.strain_limit &&
      scene.model.tearing->breaking_elongation >= scene.model.strain_limit->stretch)
    reader.at("breaking_elongation")
        .fail("a number below the strain limit's stretch, which no edge exceeds");
  if (scene.method.first_contact > 0)
    reader.fail("no such key beside a first contact, which is looked for on one mesh");
  if (scene.record.format == FrameFormat::binary)
    reader.fail("frames in files of their own, as their vertices grow in number");
}

std::optional<TornCloth> Tearing::torn(const RestCloth& cloth, std::span<const GaugeEdge> gauge,
                                       const Positions& positions,
                                       std::span<const Pin> pins) const {
  std::vector<Overload> overloads;
  for (const GaugeEdge& edge : gauge)
    if (const double e = strain(edge, positions); e > breaking_elongation)
      overloads.push_back({&edge, e});
  if (overloads.empty()) return std::nullopt;
  std::stable_sort(overloads.begin(), overloads.end(),
                   [](const Overload& a, const Overload& b) { return a.strain > b.strain; });
  Tear tear(cloth, gauge, positions, pins);
  const std::vector<int> regions = tear.regions(overloads);
  std::vector<char> has_given_way(regions.size(), 0);
  for (const Overload& overload : overloads) {
    char& is_unloaded = has_given_way[static_cast<std::size_t>(regions[overload.edge->a])];
    if (is_unloaded == 0 && tear.give_way(*overload.edge)) is_unloaded = 1;
  }
  if (tear.faces().origins().empty()) return std::nullopt;
  return TornCloth{with_faces(cloth, tear.faces()), tear.faces().origins()};
}

Positions Tearing::split(const Positions& columns, std::span<const VertexId> origins) const {
  return with_split(columns, origins);
}

Positions Tearing::shared(const Positions& forces, const Eigen::VectorXd& masses_before,
                          const Eigen::VectorXd& masses, std::span<const VertexId> origins) const {
  const Positions accelerations = forces * masses_before.cwiseInverse().asDiagonal();
  return with_split(accelerations, origins) * masses.asDiagonal();
}

std::shared_ptr<const Tearing> read_tearing(const JsonReader& reader) {
  reader.allow_keys({"breaking_elongation"});
  auto tearing = std::make_shared<Tearing>();
  tearing->breaking_elongation = reader.at("breaking_elongation").number(kPositive);
  return tearing;
}

void expect_whole(const Scene& scene) {
  if (scene.model.tearing)
    throw InputError("/model/tearing",
                     "expected no such key here, where a cloth has to keep its vertices");
}

}  // namespace pleat
