#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/ids.h"
#include "core/base/vec.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// A node of the quadtree: a quad that is either active (part of the mesh) or split into four
/// children.
///
/// Corners run around the face. Edges 0-1 and 3-2 lie along warp, edges 0-3 and 1-2 along weft;
/// child k holds corner k.
struct QuadFace {
  std::array<VertexId, 4> corners;
  std::array<FaceId, 4> children;  ///< invalid while active
  FaceId parent;                   ///< invalid for a base face
  int level = 0;                   ///< 0 for a base face
  bool diagonal_02 = true;         ///< its two triangles share the diagonal 0-2, else 1-3

  bool active() const { return !children[0].valid(); }
};

/// The vertices whose mean a refinement vertex is: 2 for an edge midpoint, 4 for a face centre,
/// none for a base vertex.
struct VertexParents {
  std::array<VertexId, 4> vertices;
  int count = 0;
};

/// A flat rectangular sheet of cells. u runs along warp, v along weft.
struct SheetShape {
  double width = 1;               ///< along weft [m], positive
  double height = 1;              ///< along warp [m], positive
  int columns = 1;                ///< cells along weft, at least 1
  int rows = 1;                   ///< cells along warp, at least 1
  Vec3 origin{0, 0, 0};           ///< place of u = v = 0 [m]
  Vec3 warp_direction{0, -1, 0};  ///< unit
  Vec3 weft_direction{1, 0, 0};   ///< unit, perpendicular to warp_direction
};

/// Most uniform refinements of a sheet; they make 65536 faces of one.
constexpr int kMaxLevel = 8;

/// A mesh of quads refined by quadtrees. New vertices are appended, so vertex i of the base mesh is
/// vertex i of every refinement.
///
/// Source: the multi-resolution quad cloth listed as M in docs/reproduction.md;
/// docs/methods/quad_mesh.md.
class QuadMesh {
 public:
  /// Vertex r (columns + 1) + c lies at u = r height / rows, v = c width / columns.
  /// Throws ContractError unless sizes and counts are positive and the directions orthonormal.
  static QuadMesh sheet(const SheetShape& shape);

  /// Splits every active face, `levels` times (0 to kMaxLevel).
  void refine_uniformly(int levels);

  int n_vertices() const { return static_cast<int>(parents_.size()); }
  std::span<const QuadFace> faces() const { return faces_; }
  const Positions& rest_positions() const { return rest_positions_; }
  const RestCoordinates& rest_coordinates() const { return rest_coordinates_; }
  std::span<const VertexParents> parents() const { return parents_; }

  /// Two per active face, both wound like the face; diagonals alternate like a chess board, so that
  /// a symmetric sheet stays symmetric.
  std::vector<Triangle> triangles() const;

  /// The same triangles with the thread directions; the sheet is flat.
  TriangleMesh triangle_mesh() const;

  /// Four per active face, wound like it: its two triangles by either diagonal, so that the face is
  /// covered twice and every corner alike.
  std::vector<Triangle> crossed_triangles() const;

  /// Rest area of each vertex: a quarter of each active face around it [m^2].
  Eigen::VectorXd vertex_areas() const;

 private:
  void split(FaceId id);
  VertexId midpoint(VertexId a, VertexId b);
  VertexId append_mean(const VertexParents& parents);

  Vec3 warp_direction_;
  Positions rest_positions_;
  RestCoordinates rest_coordinates_;
  std::vector<VertexParents> parents_;
  std::vector<QuadFace> faces_;
  std::unordered_map<std::uint64_t, VertexId> midpoints_;  // by edge; only looked up, never walked
};

}  // namespace pleat
