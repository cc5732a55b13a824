#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/simd.h"
#include "core/base/vec.h"

namespace pleat {

/// Largest coordinate [m], beyond which a place is lost: sums of such overflow no float.
constexpr double kFarthest = 1e30;

/// Bounds when some time begins and when it ends [m]; each goes straight in between. The fourth
/// lane tells an empty box, which overlaps none, and what may overlap what.
struct MovingBox {
  Float4 low_begin, high_begin, low_end, high_end;
};

/// Surfaces that a box is around part of: boxes of loose cloth overlap none of loose cloth, those
/// of bodies none of bodies.
enum class BoxGroup : std::uint8_t { cloth, loose_cloth, body };

/// Puts a box that is around cloth into its group. Boxes that are merged overlap what one of them
/// does.
void set_group(MovingBox& box, BoxGroup group);

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

/// A binary tree of moving boxes, to find those that overlap each other. All its leaves are equally
/// deep.
class MovingBoxes {
 public:
  /// Two leaves, the lower number first.
  struct LeafPair {
    int a, b;
  };

  /// Makes the tree anew, split at medians of the boxes' middles.
  void build(std::span<const MovingBox> boxes);

  /// Numbers of the boxes that it was built from, leaf by leaf.
  std::span<const int> order() const { return order_; }
  int n_leaves() const { return 1 << depth_; }
  /// Place in `order` where a leaf begins and the one before ends.
  int first_of(int leaf) const { return first_of(depth_, leaf); }

  /// Keeps the tree and fits it to boxes that have changed, ordered as `order` has them. Returns
  /// half the surface of all its boxes at both ends [m^2]; what overlaps grows with it.
  double fit(std::span<const MovingBox> ordered);

  /// Leaves whose boxes overlap, each pair once; nothing where there are more than `most`. Valid
  /// until it is called again.
  std::optional<std::span<const LeafPair>> overlapping_leaves(std::size_t most);

  /// Memory that it holds [bytes].
  std::size_t bytes() const;

 private:
  int first_of(int level, int node) const {
    return static_cast<int>((static_cast<std::int64_t>(node) * n_boxes() >> level));
  }
  std::int64_t n_boxes() const { return static_cast<std::int64_t>(order_.size()); }

  std::vector<int> order_;
  int depth_ = 0;
  std::vector<MovingBox>
      boxes_;                  // box of each node, level by level; its children are 2 n + 1 and on
  std::vector<Vec3> middles_;  // middle of each box that it was built from
  std::vector<LeafPair> pairs_, next_pairs_;
};

}  // namespace pleat
