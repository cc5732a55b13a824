#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// Lengths of shortest paths on the unstrained surface of a mesh. They know the lengths of its
/// edges alone, so a garment has those of its pattern however it stands in space.
///
/// A shortest path is straight across triangles laid flat, and turns only at vertices whose angles
/// sum to more than a full turn, or on a border to more than half of one. So straight paths from
/// the start and from such vertices, joined by Dijkstra's algorithm, are exact. Every length is
/// that of a path on the surface: rounding apart, no strain-free cloth is stretched by it.
///
/// Source: Mitchell, Mount & Papadimitriou, The discrete geodesic problem, SIAM Journal on
/// Computing 1987 (straight paths as windows on edges; here none is trimmed by another, as paths
/// are a few edges long).
class SurfaceDistances {
 public:
  explicit SurfaceDistances(const TriangleMesh& mesh);

  /// From `start` to each of `ends`, all in its connected part [m].
  std::vector<double> to(VertexId start, const std::vector<VertexId>& ends);

 private:
  using Vec2 = Eigen::Vector2d;
  struct HalfEdge {
    VertexId from;
    double length = 0;       ///< [m]
    std::int32_t twin = -1;  ///< -1: border
  };
  /// What is seen of an edge from a start at the origin, laid flat: `right` to `left` are its ends,
  /// the rays to `from` and `to` bound what is seen.
  struct Window {
    std::int32_t half_edge;
    Vec2 right, left, from, to;
  };
  struct Reached {
    double distance;
    VertexId vertex;
    bool operator>(const Reached& other) const { return distance > other.distance; }
  };

  const HalfEdge& edge(std::int32_t h) const { return edges_[static_cast<std::size_t>(h)]; }
  void find_turns();
  double settle_along_edges(VertexId start, const std::vector<VertexId>& ends);
  void go_straight(VertexId start, double limit);
  void cross(const Window& window, double begin, double limit);
  void reach(VertexId vertex, double distance);

  std::vector<HalfEdge> edges_;  ///< three of each triangle, from its corners in turn
  std::vector<std::vector<std::int32_t>> from_;  ///< half-edges from each vertex
  std::vector<bool> can_turn_;
  std::vector<double> distance_;  ///< of the search that runs; -1: not reached
  std::vector<VertexId> touched_;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue_;
  std::vector<Window> windows_;
};

}  // namespace pleat
