#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/simd.h"
#include "core/base/vec.h"

namespace pleat {

/// Largest coordinate [m], beyond which a place is lost: sums of such overflow no float.
constexpr double kFarthest = 1e30;

/// Bounds when some time begins and when it ends [m]; each goes straight in between. The fourth
/// lane only tells an empty box, which overlaps none, from others.
struct MovingBox {
  Float4 low_begin, high_begin, low_end, high_end;
};

/// Box around a point on its way, larger by `reach` to either side on each axis. It is rounded
/// outward, by at most 4e-7 of the distance from the origin and of the reach.
///
/// begin, end  of the way, three coordinates each [m]
/// reach       [m], not below 0
/// origin      of the bounds, within kFarthest [m]
///
/// The box is empty where anything is not finite or beyond kFarthest.
MovingBox box_on_way(const double* begin, const double* end, double reach, const Vec3& origin);

inline MovingBox merged(const MovingBox& a, const MovingBox& b) {
  return {min(a.low_begin, b.low_begin), max(a.high_begin, b.high_begin), min(a.low_end, b.low_end),
          max(a.high_end, b.high_end)};
}

inline bool is_empty(const MovingBox& box) { return box.low_begin.value[3] > 0; }

/// False where on some axis the same box lies above the other at both ends, or touches it.
inline bool overlap(const MovingBox& a, const MovingBox& b) {
  const Float4 a_into_b = max(a.high_begin - b.low_begin, a.high_end - b.low_end);
  const Float4 b_into_a = max(b.high_begin - a.low_begin, b.high_end - a.low_end);
  return positive_lanes(min(a_into_b, b_into_a)) == 15;
}

/// A binary tree of moving boxes, to find those that overlap each other.
class MovingBoxes {
 public:
  /// A run of boxes in `order`.
  struct Leaf {
    int begin = 0, end = 0;
  };

  /// Makes the tree anew, split at medians of the boxes' middles.
  void build(std::span<const MovingBox> boxes);

  /// Numbers of the boxes that it was built from, leaf by leaf.
  std::span<const int> order() const { return order_; }
  std::span<const Leaf> leaves() const { return leaves_; }

  /// Keeps the tree and fits it to boxes that have changed, ordered as `order` has them. Returns
  /// half the surface of all its boxes at both ends [m^2], which is what `visit` has to look at.
  double fit(std::span<const MovingBox> ordered);

  /// Calls visit(a, b), a < b, with the numbers of any two leaves whose boxes overlap.
  template <class Visit>
  void visit(Visit&& visit);

  /// Memory that it holds [bytes].
  std::size_t bytes() const;

 private:
  static constexpr int kLeafSize = 2;

  /// Children of node n are n + 1 and `second`; a leaf has none.
  struct Node {
    int second = 0;
    int leaf = 0;  // first of its leaves

    bool is_leaf() const { return second == 0; }
  };

  void split(int begin, int end);

  std::vector<int> order_;
  std::vector<Leaf> leaves_;
  std::vector<Node> nodes_;
  std::vector<MovingBox> boxes_;             // box of each node
  std::vector<Vec3> middles_;                // middle of each box that it was built from
  std::vector<std::array<int, 2>> waiting_;  // pairs of nodes to visit
};

template <class Visit>
void MovingBoxes::visit(Visit&& visit) {
  for (std::size_t parent = 0; parent < nodes_.size(); ++parent) {
    if (nodes_[parent].is_leaf()) continue;
    waiting_.push_back({static_cast<int>(parent) + 1, nodes_[parent].second});
    while (!waiting_.empty()) {
      const auto [a, b] = waiting_.back();
      waiting_.pop_back();
      if (!overlap(boxes_[a], boxes_[b])) continue;
      const Node& node_a = nodes_[a];
      const Node& node_b = nodes_[b];
      if (node_a.is_leaf() && node_b.is_leaf()) {
        visit(node_a.leaf, node_b.leaf);
      } else if (node_a.is_leaf()) {
        waiting_.push_back({a, b + 1});
        waiting_.push_back({a, node_b.second});
      } else if (node_b.is_leaf()) {
        waiting_.push_back({a + 1, b});
        waiting_.push_back({node_a.second, b});
      } else {
        waiting_.push_back({a + 1, b + 1});
        waiting_.push_back({a + 1, node_b.second});
        waiting_.push_back({node_a.second, b + 1});
        waiting_.push_back({node_a.second, node_b.second});
      }
    }
  }
}

}  // namespace pleat
