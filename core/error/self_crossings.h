#pragma once

#include <cstdint>
#include <optional>

#include "core/mesh/quad_mesh.h"
#include "core/mesh/triangle_boxes.h"

namespace pleat {

/// Counts where a cloth passes through itself: pairs of an edge and a triangle that cross, the edge
/// having its ends on either side of the triangle and going through its inside.
///
/// Neighbours, which share a vertex, are left out; one that hangs counts as its parents too, and
/// the edge that it halves only by its halves. What touches does not cross: an edge that ends on a
/// triangle, lies in its plane or meets its border is not counted, nor one that does so but for
/// 1e-15 of the largest coordinate, some roundings. Folds between neighbours are not seen.
class SelfCrossings {
 public:
  /// positions  where the triangles lie near those they will be near to, such as at rest [m]
  /// hanging    of these triangles
  SelfCrossings(const std::vector<Triangle>& triangles, const PositionsView& positions,
                std::span<const HangingVertex> hanging = {});

  /// positions  of the same vertices, finite [m]
  std::int64_t count(const PositionsView& positions);

 private:
  struct Member {
    Triangle corners;
    std::array<bool, 3> owns;  // each edge is that of one triangle; edge k begins at corner k
    Eigen::AlignedBox3d box;   // box around the triangle
  };

  bool are_neighbours(VertexId v, const Triangle& triangle) const;
  bool crosses(const Member& edges, int edge, const Member& triangle) const;
  std::int64_t between(const Member& a, const Member& b) const;
  std::int64_t within(std::size_t node) const;
  std::int64_t between(std::size_t node_a, std::size_t node_b) const;

  Positions positions_;
  double slack_ = 0;  // how far vertices may be from where they were meant [m]
  std::vector<std::array<VertexId, 2>> parents_;  // parents of each vertex; invalid unless it hangs
  std::optional<TriangleBoxes> boxes_;            // none without triangles
  std::vector<Member> members_;                   // members in the order of the boxes
  std::vector<Corners> corners_;
};

/// Counts the crossings of one shape.
std::int64_t self_crossings(const std::vector<Triangle>& triangles, const PositionsView& positions,
                            std::span<const HangingVertex> hanging = {});

}  // namespace pleat
