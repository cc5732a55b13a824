#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/ids.h"
#include "core/base/vec.h"
#include "core/mesh/quad_patch.h"
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

/// A vertex in the middle of a coarser face's edge: no unknown, it stays in the middle of its
/// parents, which do not hang.
struct HangingVertex {
  VertexId vertex;
  std::array<VertexId, 2> parents;
};

/// A flat rectangular sheet of cells. u runs along warp, v along weft.
struct SheetShape {
  double width = 1;               ///< extent along weft [m], positive
  double height = 1;              ///< extent along warp [m], positive
  int columns = 1;                ///< cells along weft, at least 1
  int rows = 1;                   ///< cells along warp, at least 1
  Vec3 origin{0, 0, 0};           ///< place of u = v = 0 [m]
  Vec3 warp_direction{0, -1, 0};  ///< unit
  Vec3 weft_direction{1, 0, 0};   ///< unit, perpendicular to warp_direction
};

/// Most uniform refinements of a sheet; they make 65536 faces of one.
constexpr int kMaxLevel = 8;

/// A mesh of quads refined by quadtrees. New vertices are appended, so vertex i of the base mesh is
/// vertex i of every refinement. Active faces with a common edge differ by one level at most.
///
/// Source: the multi-resolution quad cloth listed as M in docs/reproduction.md;
/// docs/methods/quad_mesh.md.
class QuadMesh {
 public:
  /// Vertex r (columns + 1) + c lies at u = r height / rows, v = c width / columns.
  /// Throws ContractError unless sizes and counts are positive and the directions orthonormal.
  static QuadMesh sheet(const SheetShape& shape);

  /// Throws InputError naming a face that is not sound: a corner that does not exist or comes
  /// twice, no area, an edge of a third face or wound against its neighbour's; or a vertex without
  /// a face.
  static QuadMesh from_patch(const QuadPatch& patch);

  /// Splits every active face, `levels` times (0 to kMaxLevel).
  void refine_uniformly(int levels);

  /// Splits faces below kMaxLevel, and before each those coarser neighbours that would then differ
  /// by two levels. A face that is split already stays as it is.
  void refine(std::span<const FaceId> faces);

  /// The faces that refining an active one would split, in that order: it is the last.
  std::vector<FaceId> balanced_splits(FaceId face);

  /// Parts the active faces: they get other corners, some of them vertices that are appended. Rest
  /// areas, threads and diagonals stay. Throws ContractError when vertices hang.
  ///
  /// corners  four for each active face
  /// origins  for each appended vertex the one before it where it is
  void tear(std::span<const VertexId> corners, std::span<const VertexId> origins);

  int n_vertices() const { return static_cast<int>(parents_.size()); }
  std::span<const QuadFace> faces() const { return faces_; }
  const Positions& rest_positions() const { return rest_positions_; }
  const RestCoordinates& rest_coordinates() const { return rest_coordinates_; }
  std::span<const VertexParents> parents() const { return parents_; }
  int n_base_faces() const { return n_base_faces_; }  ///< the first ones

  /// Ordered by the active faces whose edges they halve.
  std::vector<HangingVertex> hanging_vertices() const;

  /// The vertex that halves the edge of a face; invalid when no face with that edge is split.
  VertexId middle(VertexId a, VertexId b) const;

  /// Two per active face, both wound like the face; diagonals alternate like a chess board where
  /// the faces allow it, so that a symmetric sheet stays symmetric. Along a hanging vertex the
  /// coarser face's edge is straight, so that nothing gapes.
  std::vector<Triangle> triangles() const;

  /// Mesh of triangles() with the thread directions.
  TriangleMesh triangle_mesh() const;

  /// Four per active face, wound like it: its two triangles by either diagonal, so that the face is
  /// covered twice and every corner alike.
  std::vector<Triangle> crossed_triangles() const;

  /// Rest area of a face [m^2]: a base face's over 4^level, so that no refinement changes the sum.
  double area(FaceId face) const;

  /// Rest area of each vertex [m^2]: a quarter of each active face around it; what would be a
  /// hanging vertex's share is half each of its parents.
  Eigen::VectorXd vertex_areas() const;

 private:
  using EdgeFaces = std::unordered_map<std::uint64_t, std::array<FaceId, 2>>;

  void add_base_face(const std::array<VertexId, 4>& corners, bool diagonal_02);
  void note_edges(FaceId id);
  void gather_splits(FaceId id, std::vector<FaceId>& splits) const;
  void split(FaceId id);
  VertexId midpoint(VertexId a, VertexId b);
  VertexId append_mean(const VertexParents& parents);
  void trim();

  std::optional<Vec3> warp_direction_;  // warp direction of a flat sheet
  int n_base_faces_ = 0;
  Positions rest_positions_;
  RestCoordinates rest_coordinates_;
  std::vector<VertexParents> parents_;
  std::vector<QuadFace> faces_;
  std::vector<double> base_areas_;
  std::unordered_map<std::uint64_t, VertexId> midpoints_;  // only looked up, never walked
  std::optional<EdgeFaces> edge_faces_;  // faces at each edge, once a single face was refined
};

}  // namespace pleat
