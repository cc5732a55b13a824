#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/ids.h"
#include "core/base/vec.h"

namespace pleat {

/// More vertices or particles are refused: their matrices would not fit into a browser's memory.
constexpr std::int64_t kMaxVertices = 1000000;

using Triangle = std::array<VertexId, 3>;

/// Texture coordinates of a triangle's corners, one column each.
using CornerTexture = Eigen::Matrix<double, 2, 3>;

/// Any triangle mesh at rest. Unstrained, its triangles are those of its flat pattern, and without
/// one those of the positions. Bending is measured from the flat state.
struct TriangleMesh {
  Positions rest_positions;           ///< [m]
  std::vector<Triangle> triangles;    ///< at most two at an edge, none without area
  std::vector<Vec3> warp_directions;  ///< one per triangle: unit, in its plane
  /// Corners of each triangle in the pattern that it is cut from, along warp and weft [m], wound as
  /// the triangle and none without area. Triangles that meet at a seam may lie apart in it. Empty:
  /// cut to the positions.
  std::vector<CornerTexture> pattern{};

  int n_vertices() const { return static_cast<int>(rest_positions.cols()); }
};

/// An edge with the triangles beside it.
struct MeshEdge {
  VertexId a, b;                   ///< ends, in the direction in which the first triangle is wound
  std::array<FaceId, 2> faces;     ///< the second is invalid at a border
  std::array<VertexId, 2> across;  ///< opposite corner in each of them

  bool is_border() const { return !faces[1].valid(); }
};

/// Every edge once, in the order in which the triangles name them. Throws ContractError where more
/// than two triangles meet.
std::vector<MeshEdge> mesh_edges(const std::vector<Triangle>& triangles);

/// Corners of a triangle laid flat without strain, relative to the first: along warp and weft [m].
CornerTexture flat_corners(const TriangleMesh& mesh, FaceId face);

/// Area of an unstrained triangle [m^2].
double rest_area(const TriangleMesh& mesh, FaceId face);

/// Length of an unstrained edge [m]: the mean over its triangles, whose sides may differ at a seam.
double rest_length(const TriangleMesh& mesh, const MeshEdge& edge);

/// Rest area of each vertex: a third of each triangle around it [m^2]. 0 for one that is in none.
Eigen::VectorXd vertex_areas(const TriangleMesh& mesh);

/// Unit direction in the triangle's plane nearest to `direction`; zero when that is perpendicular
/// to the plane or the triangle has no area.
Vec3 direction_in_plane(const Vec3& direction, const Vec3& x0, const Vec3& x1, const Vec3& x2);

/// Splits every triangle into four at the middles of its edges, `levels` times. Vertices keep their
/// numbers, edge middles are appended; `middles` (may be null) gets the two ends of each of these.
TriangleMesh subdivided(TriangleMesh mesh, int levels,
                        std::vector<std::array<VertexId, 2>>* middles = nullptr);

}  // namespace pleat
