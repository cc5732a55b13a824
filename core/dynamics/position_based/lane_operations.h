#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/simd.h"

namespace pleat {

/// Compliance of a rigid constraint, relative to the inverse masses: far below what their sum
/// rounds off, but a denominator that never is zero, even between pinned vertices.
constexpr float kRigidCompliance = 1e-12f;
/// Share of the denominator in a lane without an element: nothing moves there.
constexpr float kEmptyLane = std::numeric_limits<float>::infinity();

/// The vertices in lane order, as projections see them: each is at begin + move. A move is small
/// against a position, so that what a projection adds to it is not rounded to the position's last
/// bit.
struct LaneView {
  std::array<float*, 3> moves;         ///< x, y, z since the substep's start [m]
  std::array<const float*, 3> begins;  ///< places at the substep's start, to single precision [m]
  const float* inverse_masses;         ///< mean mass / mass; 0 where pinned and in padding
};

template <class Lanes, class Pointer>
Vec3Lanes<Lanes> load(const std::array<Pointer, 3>& arrays, int slot) {
  return {Lanes::load(arrays[0] + slot), Lanes::load(arrays[1] + slot),
          Lanes::load(arrays[2] + slot)};
}

template <class Lanes>
void store(const Vec3Lanes<Lanes>& value, const std::array<float*, 3>& arrays, int slot) {
  value.x.store(arrays[0] + slot);
  value.y.store(arrays[1] + slot);
  value.z.store(arrays[2] + slot);
}

/// Adds to a multiplier, which the first sweep takes as zero.
template <bool first, class Lanes>
void add_to_multiplier(Lanes change, float* multiplier) {
  if constexpr (first)
    change.store(multiplier);
  else
    (Lanes::load(multiplier) + change).store(multiplier);
}

/// One number per lane, and the index of the element in each lane, or -1.
template <class Value>
using PerLane = std::array<Value, Float4::kLanes>;
using LaneMembers = PerLane<int>;
constexpr LaneMembers kNoMembers{-1, -1, -1, -1};

/// An element that wants a lane, and the rank of the operation that it belongs to.
struct LaneCandidate {
  std::array<int, 3> first_slots;  ///< groups it works on; the third may be unused
  int lane = 0;
  int element = 0;
  std::array<int, 5> rank;
};

/// Elements that are computed together: they work on the same groups, each in its own lane.
struct LaneOperation {
  std::array<int, 3> first_slots;
  LaneMembers members;
};

/// Operations that follow on one another and are computed alike.
struct OperationStretch {
  int begin, end;
  bool whole;  ///< false where the groups of one operation overlap: then lane by lane
};

/// Puts candidates that touch the same groups into one operation and orders these by rank.
std::vector<LaneOperation> compile_operations(std::vector<LaneCandidate> candidates);

/// Appends operation `index`, which works on these groups, to the last stretch, or begins one.
void append_to_stretches(std::vector<OperationStretch>& stretches, int index,
                         const std::array<int, 3>& first_slots, int n_groups);

/// Calls work(index, lane, Float4 or Float1) over all stretches, in order.
template <class Work>
void for_each_operation(const std::vector<OperationStretch>& stretches,
                        const std::vector<LaneMembers>& members, Work work) {
  for (const OperationStretch& stretch : stretches) {
    if (stretch.whole) {
      for (int i = stretch.begin; i < stretch.end; ++i) work(i, 0, Float4{});
      continue;
    }
    for (int i = stretch.begin; i < stretch.end; ++i)
      for (int lane = 0; lane < Float4::kLanes; ++lane)
        if (members[static_cast<std::size_t>(i)][static_cast<std::size_t>(lane)] >= 0)
          work(i, lane, Float1{});
  }
}

}  // namespace pleat
