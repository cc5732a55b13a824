#include "core/mesh/quad_mesh.h"

#include <cmath>

#include "core/base/check.h"

namespace pleat {
namespace {

constexpr double kDirectionTolerance = 1e-9;  // of unit length and right angle

std::uint64_t edge_key(VertexId a, VertexId b) {
  const auto low = static_cast<std::uint32_t>(std::min(a.value, b.value));
  const auto high = static_cast<std::uint32_t>(std::max(a.value, b.value));
  return (static_cast<std::uint64_t>(low) << 32) | high;
}

void check_shape(const SheetShape& shape) {
  PLEAT_CHECK(shape.width > 0 && shape.height > 0, "a sheet has positive width and height");
  PLEAT_CHECK(shape.columns >= 1 && shape.rows >= 1, "a sheet has at least one cell");
  PLEAT_CHECK(std::abs(shape.warp_direction.norm() - 1) < kDirectionTolerance &&
                  std::abs(shape.weft_direction.norm() - 1) < kDirectionTolerance &&
                  std::abs(shape.warp_direction.dot(shape.weft_direction)) < kDirectionTolerance,
              "warp and weft directions are orthonormal");
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
      QuadFace face;
      face.corners = {VertexId(first), VertexId(first + line), VertexId(first + line + 1),
                      VertexId(first + 1)};
      face.diagonal_02 = (r + c) % 2 == 0;
      mesh.faces_.push_back(face);
    }
  }
  return mesh;
}

VertexId QuadMesh::append_mean(const VertexParents& parents) {
  const VertexId id(n_vertices());
  Vec3 position = Vec3::Zero();
  Eigen::Vector2d coordinates = Eigen::Vector2d::Zero();
  for (int k = 0; k < parents.count; ++k) {
    position += rest_positions_.col(parents.vertices[k]);
    coordinates += rest_coordinates_.col(parents.vertices[k]);
  }
  parents_.push_back(parents);
  if (rest_positions_.cols() <= id) {  // grown geometrically here, trimmed by refine_uniformly
    rest_positions_.conservativeResize(3, 2 * id.value + 1);
    rest_coordinates_.conservativeResize(2, 2 * id.value + 1);
  }
  rest_positions_.col(id) = position / parents.count;
  rest_coordinates_.col(id) = coordinates / parents.count;
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
  }
}

void QuadMesh::refine_uniformly(int levels) {
  PLEAT_CHECK(levels >= 0 && levels <= kMaxLevel, "between 0 and 8 refinements");
  for (int level = 0; level < levels; ++level) {
    const std::size_t n_faces = faces_.size();
    for (std::size_t f = 0; f < n_faces; ++f) {
      if (faces_[f].active()) split(FaceId(static_cast<std::int64_t>(f)));
    }
  }
  rest_positions_.conservativeResize(3, n_vertices());
  rest_coordinates_.conservativeResize(2, n_vertices());
}

std::vector<Triangle> QuadMesh::triangles() const {
  std::vector<Triangle> result;
  for (const QuadFace& face : faces_)
    if (face.active()) append_halves(face.corners, face.diagonal_02, result);
  return result;
}

TriangleMesh QuadMesh::triangle_mesh() const {
  TriangleMesh mesh{rest_positions_, triangles(), {}};
  mesh.warp_directions.assign(mesh.triangles.size(), warp_direction_);
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

Eigen::VectorXd QuadMesh::vertex_areas() const {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(n_vertices());
  for (const QuadFace& face : faces_) {
    if (!face.active()) continue;
    const auto corner = [&](int k) { return Vec3(rest_positions_.col(face.corners[k])); };
    const double area = 0.5 * (corner(2) - corner(0)).cross(corner(3) - corner(1)).norm();
    for (const VertexId v : face.corners) areas[v] += area / 4;
  }
  return areas;
}

}  // namespace pleat
