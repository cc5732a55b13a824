#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// Lengths of shortest paths on the unstrained surface of a mesh. They know the lengths of its
/// edges alone, so a garment has those of its pattern however it stands in space.
///
/// A shortest path is straight across triangles laid flat, and turns only at vertices whose angles
/// sum to more than a full turn, or on a border to more than half of one; it leaves half a turn to
/// either side there. So straight paths from the start, and from such vertices into the few
/// directions that this leaves, joined by Dijkstra's algorithm, are exact.
///
/// Source: Mitchell, Mount & Papadimitriou, The discrete geodesic problem, SIAM Journal on
/// Computing 1987 (windows on edges; here none is trimmed by another).
class SurfaceDistances {
 public:
  explicit SurfaceDistances(const TriangleMesh& mesh);

  /// Distances from `start` to each of `ends`, all in its connected part [m].
  std::vector<double> to(VertexId start, const std::vector<VertexId>& ends);

 private:
  using Vec2 = Eigen::Vector2d;
  struct HalfEdge {
    VertexId from;
    std::int32_t twin = -1;  ///< -1: border
    double length = 0;       ///< [m]
    /// Third corner of its triangle, in lengths of this edge along and beside it.
    Vec2 third = Vec2::Zero();
    double corner = 0;  ///< angle of the triangle at `from` [rad]
    double angle = 0;   ///< direction around `from`, counter-clockwise from its first edge [rad]
  };
  /// Visible part of an edge, seen from a start at the origin and laid flat: `right` and `left` are
  /// the edge's ends, the rays `from` and `to` bound what is seen.
  struct Window {
    std::int32_t half_edge;
    Vec2 right, left, from, to;
  };
  struct Reached {
    double distance;
    VertexId vertex;
    bool operator>(const Reached& other) const { return distance > other.distance; }
  };
  struct Arrival {
    double distance = std::numeric_limits<double>::infinity();  ///< [m]
    double angle = 0;  ///< direction around the vertex in which the path comes in [rad]
  };

  const HalfEdge& edge(std::int32_t h) const { return edges_[static_cast<std::size_t>(h)]; }
  void find_shapes();
  void find_turns(VertexId vertex);
  bool can_turn(VertexId vertex) const;
  double farthest(const std::vector<VertexId>& ends) const;
  void go_along_edges(VertexId vertex);
  bool search(VertexId start, const std::vector<VertexId>& ends, double limit);
  void go_on_from(VertexId vertex, double limit);
  void look_through(std::int32_t half_edge, double from_angle, double to_angle);
  void cross(const Window& window, double start_distance, double limit);
  void reach(VertexId vertex, const Arrival& arrival);
  void push(VertexId vertex);
  Reached pop();

  Positions places_;
  double length_of_all_ = 0;     ///< edges [m]
  std::vector<HalfEdge> edges_;  ///< three of each triangle, from its corners in turn
  std::vector<std::vector<std::int32_t>> from_;  ///< half-edges from each vertex
  /// Excess of each vertex's angles over what a path needs that does not turn [rad].
  std::vector<double> free_angle_;
  std::vector<Arrival> arrivals_;  ///< arrivals of the current search
  std::vector<VertexId> touched_;
  std::vector<Reached> queue_;  ///< a heap
  std::vector<Window> windows_;
};

}  // namespace pleat
