#pragma once

#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/base/vec.h"

namespace pleat {

/// The faces of a mesh that is being cut: which vertices they have, and nothing of where these are.
///
/// A vertex is a fan of faces around a point that edges join. A cut parts faces along edges; where
/// a fan falls apart, the part of its first face keeps the vertex, and each other one gets a new
/// vertex, appended. Two faces have an edge in common as long as they have both of its ends. So a
/// mesh whose vertices are fans stays one. Source: docs/methods/tearing.md.
class CutFaces {
 public:
  /// corners    of one face after the other, wound alike, at most two faces at an edge
  /// n_corners  of each face, 3 or 4
  CutFaces(std::vector<VertexId> corners, int n_corners, int n_vertices);

  /// Faces around a vertex, ascending.
  std::span<const FaceId> faces_at(VertexId vertex) const { return faces_at_[vertex]; }
  std::span<const VertexId> corners_of(FaceId face) const {
    return std::span(corners_).subspan(n_corners_ * static_cast<std::size_t>(face), n_corners_);
  }

  /// Cuts the edges at `vertex` between those of its faces that are `far` and those that are not.
  /// That splits the vertex, and of the other ends of these edges those that it cuts off: at a
  /// border. Returns them; none, and nothing is cut, when all its faces are on one side or when one
  /// is held that would split.
  ///
  /// far      faces around the vertex
  /// is_held  for each vertex that there was at the start
  std::vector<VertexId> cut(VertexId vertex, std::span<const FaceId> far,
                            std::span<const char> is_held);

  /// Corners of one face after the other, in the order given, with the present vertices.
  const std::vector<VertexId>& corners() const { return corners_; }
  /// Vertex that each appended one was split from.
  const std::vector<VertexId>& origins() const { return origins_; }

 private:
  struct Sides;
  std::vector<int> fans(VertexId at, const Sides& sides) const;
  void give_fans(VertexId vertex, const std::vector<int>& numbers);
  VertexId neighbour(FaceId face, VertexId at, std::size_t steps) const;

  std::vector<VertexId> corners_;
  std::size_t n_corners_;
  std::vector<std::vector<FaceId>> faces_at_;
  std::vector<VertexId> origins_;
};

/// Columns with those of the vertices that cuts appended: as the ones that they were split from.
template <class Columns>
Columns with_split(const Columns& columns, std::span<const VertexId> origins) {
  Columns all(columns.rows(), columns.cols() + static_cast<Eigen::Index>(origins.size()));
  all.leftCols(columns.cols()) = columns;
  Eigen::Index next = columns.cols();
  for (const VertexId origin : origins) all.col(next++) = all.col(origin);
  return all;
}

}  // namespace pleat
