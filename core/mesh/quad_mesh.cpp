#include "core/mesh/quad_mesh.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/mesh/cut_faces.h"
#include "core/mesh/edge_key.h"

namespace pleat {
namespace {

constexpr double kDirectionTolerance = 1e-9;  // relative to unit length and a right angle

void check_shape(const SheetShape& shape) {
  PLEAT_CHECK(shape.width > 0 && shape.height > 0, "a sheet has positive width and height");
  PLEAT_CHECK(shape.columns >= 1 && shape.rows >= 1, "a sheet has at least one cell");
  PLEAT_CHECK(std::abs(shape.warp_direction.norm() - 1) < kDirectionTolerance &&
                  std::abs(shape.weft_direction.norm() - 1) < kDirectionTolerance &&
                  std::abs(shape.warp_direction.dot(shape.weft_direction)) < kDirectionTolerance,
              "warp and weft directions are orthonormal");
}

/// Weft coordinate of the middle between two vertices. Where a tube round along weft closes, it
/// jumps from the end to the start: the middle goes on from the end.
double middle_coordinate(const Positions& x, const RestCoordinates& uv, int a, int b) {
  constexpr double kSeam = 2;  // lengths of the edge; coordinates differ by more at a seam only
  const double length = (x.col(a) - x.col(b)).norm();
  if (std::abs(uv(1, a) - uv(1, b)) <= kSeam * length) return (uv(1, a) + uv(1, b)) / 2;
  return std::max(uv(1, a), uv(1, b)) + length / 2;
}

void append_halves(const std::array<VertexId, 4>& c, bool diagonal_02,
                   std::vector<Triangle>& triangles) {
  if (diagonal_02) {
    triangles.push_back({c[0], c[1], c[2]});
    triangles.push_back({c[0], c[2], c[3]});
  } else {
    triangles.push_back({c[0], c[1], c[3]});
    triangles.push_back({c[1], c[2], c[3]});
  }
}

}  // namespace

QuadMesh QuadMesh::sheet(const SheetShape& shape) {
  check_shape(shape);
  QuadMesh mesh;
  mesh.warp_direction_ = shape.warp_direction;
  const int line = shape.columns + 1;
  const int n = line * (shape.rows + 1);
  mesh.rest_positions_.resize(3, n);
  mesh.rest_coordinates_.resize(2, n);
  mesh.parents_.resize(static_cast<std::size_t>(n));
  for (int r = 0; r <= shape.rows; ++r) {
    for (int c = 0; c <= shape.columns; ++c) {
      const double u = shape.height * (static_cast<double>(r) / shape.rows);
      const double v = shape.width * (static_cast<double>(c) / shape.columns);
      mesh.rest_coordinates_.col(r * line + c) << u, v;
      mesh.rest_positions_.col(r * line + c) =
          shape.origin + u * shape.warp_direction + v * shape.weft_direction;
    }
  }
  for (int r = 0; r < shape.rows; ++r) {
    for (int c = 0; c < shape.columns; ++c) {
      const int first = r * line + c;
      mesh.add_base_face({VertexId(first), VertexId(first + line), VertexId(first + line + 1),
                          VertexId(first + 1)},
                         (r + c) % 2 == 0);
    }
  }
  return mesh;
}

QuadMesh QuadMesh::from_patch(const QuadPatch& patch) {
  check_patch(patch);
  const std::vector<bool> white = chess_board(patch);
  QuadMesh mesh;
  mesh.rest_positions_ = patch.rest_positions;
  mesh.rest_coordinates_ = patch.rest_coordinates;
  mesh.parents_.resize(static_cast<std::size_t>(patch.rest_positions.cols()));
  for (std::size_t f = 0; f < patch.quads.size(); ++f) mesh.add_base_face(patch.quads[f], white[f]);
  return mesh;
}

void QuadMesh::add_base_face(const std::array<VertexId, 4>& corners, bool diagonal_02) {
  QuadFace face;
  face.corners = corners;
  face.diagonal_02 = diagonal_02;
  faces_.push_back(face);
  base_areas_.push_back(quad_area(rest_positions_, corners));
  ++n_base_faces_;
}

VertexId QuadMesh::append_mean(const VertexParents& parents) {
  const VertexId id(n_vertices());
  const auto& p = parents.vertices;
  Vec3 position = Vec3::Zero();
  Eigen::Vector2d coordinates = Eigen::Vector2d::Zero();
  for (int k = 0; k < parents.count; ++k) {
    position += rest_positions_.col(p[k]);
    coordinates += rest_coordinates_.col(p[k]);
  }
  coordinates /= parents.count;
  const auto middle = [&](int k, int j) {
    return middle_coordinate(rest_positions_, rest_coordinates_, p[k], p[j]);
  };
  coordinates[1] = parents.count == 2 ? middle(0, 1) : (middle(0, 3) + middle(1, 2)) / 2;
  parents_.push_back(parents);
  if (rest_positions_.cols() <= id) {  // grown geometrically here, trimmed when refining ends
    rest_positions_.conservativeResize(3, 2 * id.value + 1);
    rest_coordinates_.conservativeResize(2, 2 * id.value + 1);
  }
  rest_positions_.col(id) = position / parents.count;
  rest_coordinates_.col(id) = coordinates;
  return id;
}

VertexId QuadMesh::midpoint(VertexId a, VertexId b) {
  const auto [place, is_new] = midpoints_.try_emplace(edge_key(a, b));
  if (is_new) place->second = append_mean({{a, b}, 2});
  return place->second;
}

void QuadMesh::split(FaceId id) {
  const std::array<VertexId, 4> c = faces_[id].corners;
  const VertexId m01 = midpoint(c[0], c[1]);
  const VertexId m12 = midpoint(c[1], c[2]);
  const VertexId m23 = midpoint(c[2], c[3]);
  const VertexId m30 = midpoint(c[3], c[0]);
  const VertexId centre = append_mean({c, 4});
  const std::array<std::array<VertexId, 4>, 4> child_corners = {{{c[0], m01, centre, m30},
                                                                 {m01, c[1], m12, centre},
                                                                 {centre, m12, c[2], m23},
                                                                 {m30, centre, m23, c[3]}}};
  for (int k = 0; k < 4; ++k) {
    QuadFace child;
    child.corners = child_corners[k];
    child.parent = id;
    child.level = faces_[id].level + 1;
    child.diagonal_02 = k % 2 == 0;
    faces_[id].children[k] = FaceId(static_cast<std::int64_t>(faces_.size()));
    faces_.push_back(child);
    if (edge_faces_) note_edges(faces_[id].children[k]);
  }
}

void QuadMesh::note_edges(FaceId id) {
  const std::array<VertexId, 4>& c = faces_[id].corners;
  for (int k = 0; k < 4; ++k) {
    std::array<FaceId, 2>& sides = (*edge_faces_)[edge_key(c[k], c[(k + 1) % 4])];
    (sides[0].valid() ? sides[1] : sides[0]) = id;
  }
}

/// A child's corner k is its parent's: the edges there are halves of the parent's, and beyond those
/// may lie a face as coarse as the parent.
void QuadMesh::gather_splits(FaceId id, std::vector<FaceId>& splits) const {
  if (std::find(splits.begin(), splits.end(), id) != splits.end()) return;
  if (const FaceId parent = faces_[id].parent; parent.valid()) {
    const std::array<VertexId, 4> c = faces_[parent].corners;
    for (int k = 0; k < 4; ++k) {
      if (faces_[parent].children[k] != id) continue;
      for (const int edge : {k, (k + 3) % 4}) {
        const auto sides = edge_faces_->at(edge_key(c[edge], c[(edge + 1) % 4]));
        const FaceId beyond = sides[0] == parent ? sides[1] : sides[0];
        if (beyond.valid() && faces_[beyond].active()) gather_splits(beyond, splits);
      }
    }
  }
  splits.push_back(id);
}

std::vector<FaceId> QuadMesh::balanced_splits(FaceId face) {
  PLEAT_CHECK(face >= 0 && face < static_cast<int>(faces_.size()) && faces_[face].active(),
              "an active face is split");
  if (!edge_faces_) {
    edge_faces_.emplace();
    for (std::size_t f = 0; f < faces_.size(); ++f)
      note_edges(FaceId(static_cast<std::int64_t>(f)));
  }
  std::vector<FaceId> splits;
  gather_splits(face, splits);
  return splits;
}

void QuadMesh::refine(std::span<const FaceId> faces) {
  for (const FaceId id : faces) {
    PLEAT_CHECK(id >= 0 && id < static_cast<int>(faces_.size()) && faces_[id].level < kMaxLevel,
                "faces below the finest level are refined");
    if (!faces_[id].active()) continue;
    for (const FaceId face : balanced_splits(id)) split(face);
  }
  trim();
}

void QuadMesh::trim() {
  rest_positions_.conservativeResize(3, n_vertices());
  rest_coordinates_.conservativeResize(2, n_vertices());
}

void QuadMesh::refine_uniformly(int levels) {
  PLEAT_CHECK(levels >= 0 && levels <= kMaxLevel, "between 0 and 8 refinements");
  for (int level = 0; level < levels; ++level) {
    const std::size_t n_faces = faces_.size();
    for (std::size_t f = 0; f < n_faces; ++f) {
      if (faces_[f].active()) split(FaceId(static_cast<std::int64_t>(f)));
    }
  }
  trim();
}

void QuadMesh::tear(std::span<const VertexId> corners, std::span<const VertexId> origins) {
  PLEAT_CHECK(hanging_vertices().empty(), "hanging vertices are not torn");
  auto corner = corners.begin();
  for (QuadFace& face : faces_) {
    if (!face.active()) continue;
    PLEAT_CHECK(corners.end() - corner >= 4, "four corners for every active face");
    std::copy(corner, corner + 4, face.corners.begin());
    corner += 4;
  }
  parents_.resize(parents_.size() + origins.size());
  rest_positions_ = with_split(rest_positions_, origins);
  rest_coordinates_ = with_split(rest_coordinates_, origins);
  edge_faces_.reset();
}

std::vector<Triangle> QuadMesh::triangles() const {
  std::vector<Triangle> result;
  for (const QuadFace& face : faces_)
    if (face.active()) append_halves(face.corners, face.diagonal_02, result);
  return result;
}

TriangleMesh QuadMesh::triangle_mesh() const {
  TriangleMesh mesh{rest_positions_, triangles(), {}};
  if (warp_direction_) {
    mesh.warp_directions.assign(mesh.triangles.size(), *warp_direction_);
    return mesh;
  }
  for (const QuadFace& face : faces_) {
    if (!face.active()) continue;
    const auto corner = [&](int k) { return Vec3(rest_positions_.col(face.corners[k])); };
    const Vec3 along = corner(1) - corner(0) + corner(2) - corner(3);
    for (int half = 0; half < 2; ++half) {
      const Triangle& t = mesh.triangles[mesh.warp_directions.size()];
      const Vec3 normal = Vec3(rest_positions_.col(t[1]) - rest_positions_.col(t[0]))
                              .cross(Vec3(rest_positions_.col(t[2]) - rest_positions_.col(t[0])))
                              .normalized();
      mesh.warp_directions.push_back((along - normal.dot(along) * normal).normalized());
    }
  }
  return mesh;
}

std::vector<Triangle> QuadMesh::crossed_triangles() const {
  std::vector<Triangle> result;
  for (const QuadFace& face : faces_) {
    if (!face.active()) continue;
    append_halves(face.corners, true, result);
    append_halves(face.corners, false, result);
  }
  return result;
}

VertexId QuadMesh::middle(VertexId a, VertexId b) const {
  const auto place = midpoints_.find(edge_key(a, b));
  return place == midpoints_.end() ? VertexId() : place->second;
}

std::vector<HangingVertex> QuadMesh::hanging_vertices() const {
  std::vector<HangingVertex> hanging;
  for (const QuadFace& face : faces_) {
    if (!face.active()) continue;
    for (int k = 0; k < 4; ++k) {
      const VertexId a = face.corners[k];
      const VertexId b = face.corners[(k + 1) % 4];
      if (const VertexId m = middle(a, b); m.valid()) hanging.push_back({m, {a, b}});
    }
  }
  return hanging;
}

double QuadMesh::area(FaceId face) const {
  FaceId root = face;
  while (faces_[root].parent.valid()) root = faces_[root].parent;
  return std::ldexp(base_areas_[root], -2 * faces_[face].level);
}

Eigen::VectorXd QuadMesh::vertex_areas() const {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(n_vertices());
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (!faces_[f].active()) continue;
    const double quarter = area(FaceId(static_cast<std::int64_t>(f))) / 4;
    for (const VertexId v : faces_[f].corners) areas[v] += quarter;
  }
  for (const HangingVertex& hanging : hanging_vertices()) {
    for (const VertexId parent : hanging.parents) areas[parent] += areas[hanging.vertex] / 2;
    areas[hanging.vertex] = 0;
  }
  return areas;
}

}  // namespace pleat
