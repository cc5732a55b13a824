#include "core/contact/moving_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/check.h"

namespace pleat {
namespace {

/// Most boxes in a leaf; one that is not the only one has more than half of it.
constexpr int kLeafSize = 2;

/// False also of what is not a number.
bool is_within_reach(double length) { return std::abs(length) < kFarthest; }

MovingBox empty_box() {
  const Float4 above = Float4::all(std::numeric_limits<float>::infinity());
  const Float4 below = Float4::all(-std::numeric_limits<float>::infinity());
  return {above, below, above, below};
}

/// Bounds of a place, the fourth lane around 0.
struct Bounds {
  Float4 low, high;
};

// Let d = x - o and u = 2^-53. d -+ r is rounded by less than 3 u (|d| + r), and by 2^-24 of itself
// as a float, or 2^-150 where that is denormal: 2^-23 (|d| + r) and 1e-44 are more than all of it.
Bounds bounds(const double* x, const Vec3& origin, double reach) {
  constexpr double kFloatRounding = 0x1p-23;
  constexpr double kSmallest = 1e-44;
  Float4::Value low{0, 0, 0, -1};
  Float4::Value high{0, 0, 0, 1};
  for (int k = 0; k < 3; ++k) {
    const double d = x[k] - origin[k];
    const double outward = reach + (kFloatRounding * (std::abs(d) + reach) + kSmallest);
    low[k] = static_cast<float>(d - outward);
    high[k] = static_cast<float>(d + outward);
  }
  return {{low}, {high}};
}

/// Half the surface of a box, 0 where it is empty.
double half_surface(Float4 low, Float4 high) {
  const Float4 size = max(high - low, Float4::all(0));
  const double x = size.value[0];
  const double y = size.value[1];
  const double z = size.value[2];
  return x * y + y * z + z * x;
}

/// Four times the middle of the box over its time; 0 where it is empty, as what is not a number has
/// no order.
Vec3 middle(const MovingBox& box) {
  const Float4 sum = (box.low_begin + box.high_begin) + (box.low_end + box.high_end);
  const Vec3 middle(sum.value[0], sum.value[1], sum.value[2]);
  return middle.allFinite() ? middle : Vec3(0, 0, 0);
}

}  // namespace

MovingBox box_on_way(const double* begin, const double* end, double reach, const Vec3& origin) {
  bool within = is_within_reach(reach);
  for (int k = 0; k < 3; ++k)
    within = within && is_within_reach(begin[k]) && is_within_reach(end[k]);
  if (!within) return empty_box();
  const Bounds at_begin = bounds(begin, origin, reach);
  const Bounds at_end = bounds(end, origin, reach);
  return {at_begin.low, at_begin.high, at_end.low, at_end.high};
}

// In the fourth lane cloth has (-1, 1) at both ends, and overlaps all. Bodies have (0, 0), nothing
// of which is inside of the other. Loose cloth has (-1/2, -1/2) and then (1/2, 1/2): it lies above
// bodies at the one end and below at the other, and above no loose cloth.
void set_group(MovingBox& box, BoxGroup group) {
  if (group == BoxGroup::cloth || is_empty(box)) return;
  const float way = group == BoxGroup::body ? 0.0F : 0.5F;
  box.low_begin.value[3] = box.high_begin.value[3] = -way;
  box.low_end.value[3] = box.high_end.value[3] = way;
}

// Splits along the longest side of the box around the middles. Node k of a level l has the boxes
// from k n / 2^l on, so that halves are equal up to one.
void MovingBoxes::build(std::span<const MovingBox> boxes) {
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0);
  middles_.clear();
  for (const MovingBox& box : boxes) middles_.push_back(middle(box));
  depth_ = 0;
  while (n_boxes() > (static_cast<std::int64_t>(kLeafSize) << depth_)) ++depth_;
  boxes_.resize((std::size_t{2} << depth_) - 1);
  for (int level = 0; level < depth_; ++level)
    for (int node = 0; node < 1 << level; ++node) {
      const auto begin = order_.begin() + first_of(level, node);
      const auto end = order_.begin() + first_of(level, node + 1);
      Eigen::AlignedBox3d around;
      for (auto box = begin; box != end; ++box) around.extend(middles_[*box]);
      Eigen::Index axis = 0;
      around.sizes().maxCoeff(&axis);
      std::nth_element(begin, order_.begin() + first_of(level + 1, 2 * node + 1), end,
                       [&](int a, int b) { return middles_[a][axis] < middles_[b][axis]; });
    }
}

double MovingBoxes::fit(std::span<const MovingBox> ordered) {
  PLEAT_CHECK(ordered.size() == order_.size(), "a tree keeps its boxes");
  double surface = 0;
  const int n_inner = n_leaves() - 1;
  for (int n = 2 * n_inner; n >= 0; --n) {
    MovingBox& box = boxes_[n];
    if (n < n_inner) {
      box = merged(boxes_[2 * n + 1], boxes_[2 * n + 2]);
    } else {
      box = empty_box();
      const int end = first_of(n - n_inner + 1);
      for (int k = first_of(n - n_inner); k < end; ++k) box = merged(box, ordered[k]);
    }
    surface +=
        half_surface(box.low_begin, box.high_begin) + half_surface(box.low_end, box.high_end);
  }
  return surface;
}

// Pairs of a level come from those of the level above: children of a pair, and the two children of
// one node. All are written, and those kept that overlap: nobody could guess which.
std::optional<std::span<const MovingBoxes::LeafPair>> MovingBoxes::overlapping_leaves(
    std::size_t most_pairs) {
  std::size_t n_pairs = 0;
  for (int level = 0; level < depth_; ++level) {
    const int n_nodes = 1 << level;
    const MovingBox* const children = boxes_.data() + (2 * n_nodes - 1);
    const std::size_t most = 4 * n_pairs + static_cast<std::size_t>(n_nodes);
    if (next_pairs_.size() < most) next_pairs_.resize(most);
    LeafPair* next = next_pairs_.data();
    for (int node = 0; node < n_nodes; ++node) {
      *next = {2 * node, 2 * node + 1};
      next += overlap(children[next->a], children[next->b]) ? 1 : 0;
    }
    for (std::size_t k = 0; k < n_pairs; ++k) {
      const LeafPair pair = pairs_[k];
      for (int a = 2 * pair.a; a < 2 * pair.a + 2; ++a)
        for (int b = 2 * pair.b; b < 2 * pair.b + 2; ++b) {
          *next = {a, b};
          next += overlap(children[a], children[b]) ? 1 : 0;
        }
    }
    n_pairs = static_cast<std::size_t>(next - next_pairs_.data());
    pairs_.swap(next_pairs_);
    if (n_pairs > most_pairs) return std::nullopt;
  }
  return std::span<const LeafPair>(pairs_.data(), n_pairs);
}

std::size_t MovingBoxes::bytes() const {
  return order_.capacity() * sizeof(int) + boxes_.capacity() * sizeof(MovingBox) +
         middles_.capacity() * sizeof(Vec3) +
         (pairs_.capacity() + next_pairs_.capacity()) * sizeof(LeafPair);
}

}  // namespace pleat
