#include "core/contact/moving_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/check.h"

namespace pleat {
namespace {

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
  constexpr double kRounding = 0x1p-23;
  constexpr double kSmallest = 1e-44;
  Float4::Value low{0, 0, 0, -1};
  Float4::Value high{0, 0, 0, 1};
  for (int k = 0; k < 3; ++k) {
    const double d = x[k] - origin[k];
    const double outward = reach + (kRounding * (std::abs(d) + reach) + kSmallest);
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

void MovingBoxes::build(std::span<const MovingBox> boxes) {
  const int n = static_cast<int>(boxes.size());
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0);
  middles_.clear();
  for (const MovingBox& box : boxes) middles_.push_back(middle(box));
  leaves_.clear();
  nodes_.clear();
  if (n > 0) split(0, n);
  boxes_.resize(nodes_.size());
}

/// Splits at the median along the longest side of the box around the middles. Halves are as deep as
/// the logarithm of their number, wherever they lie.
void MovingBoxes::split(int begin, int end) {
  const std::size_t index = nodes_.size();
  nodes_.push_back({0, static_cast<int>(leaves_.size())});
  if (end - begin <= kLeafSize) {
    leaves_.push_back({begin, end});
    return;
  }
  Eigen::AlignedBox3d around;
  for (int k = begin; k < end; ++k) around.extend(middles_[order_[k]]);
  Eigen::Index axis = 0;
  around.sizes().maxCoeff(&axis);
  const int half = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                   [this, axis](int a, int b) { return middles_[a][axis] < middles_[b][axis]; });
  split(begin, half);
  nodes_[index].second = static_cast<int>(nodes_.size());
  split(half, end);
}

double MovingBoxes::fit(std::span<const MovingBox> ordered) {
  PLEAT_CHECK(ordered.size() == order_.size(), "a tree keeps its boxes");
  double surface = 0;
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    if (nodes_[n].is_leaf()) {
      const Leaf& leaf = leaves_[nodes_[n].leaf];
      boxes_[n] = ordered[leaf.begin];
      for (int k = leaf.begin + 1; k < leaf.end; ++k) boxes_[n] = merged(boxes_[n], ordered[k]);
    } else {
      boxes_[n] = merged(boxes_[n + 1], boxes_[nodes_[n].second]);
    }
    surface += half_surface(boxes_[n].low_begin, boxes_[n].high_begin) +
               half_surface(boxes_[n].low_end, boxes_[n].high_end);
  }
  return surface;
}

std::size_t MovingBoxes::bytes() const {
  return order_.capacity() * sizeof(int) + leaves_.capacity() * sizeof(Leaf) +
         nodes_.capacity() * sizeof(Node) + boxes_.capacity() * sizeof(MovingBox) +
         middles_.capacity() * sizeof(Vec3) + waiting_.capacity() * sizeof(waiting_[0]);
}

}  // namespace pleat
