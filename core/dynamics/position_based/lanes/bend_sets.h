#pragma once

#include <vector>

#include "core/dynamics/position_based/lane_layout.h"
#include "core/dynamics/position_based/lane_operations.h"
#include "core/dynamics/position_based/lanes/bend_chains.h"

namespace pleat {

/// Up to four chains that share no vertex and are solved together.
struct BendSet {
  LaneMembers chains = kNoMembers;  ///< index of the chain in each lane
  bool in_groups = false;           ///< each place is one group: one slot stands for four
  int n_beside = 0;                 ///< sets after it that are one group further each, at most 3
  int stride = 0;                   ///< the layout's, where the chains are whole rows; else 0
  int n_bends = 0;                  ///< the longest chain's
  int first_slot = 0;               ///< index into BendSets::slots
  int first_place = 0;              ///< index into the numbers of places that a program keeps
  int first_multiplier = 0;         ///< index; each place with an element has three groups
};

struct BendSets {
  std::vector<BendSet> sets;
  /// Slots of each set's vertices, place by place: that of a group, or of four lanes. A lane
  /// without a vertex has slot 0, padding.
  std::vector<int> slots;
};

/// Puts each chain into one set. Chains that run through the same groups, each in its lane, come
/// first; of the others four of about one length come together, the shortest first.
BendSets bend_sets(const std::vector<BendChain>& chains, const LaneLayout& layout);

}  // namespace pleat
