#include "core/dynamics/position_based/lanes/bend_sets.h"

#include <algorithm>
#include <map>
#include <utility>

namespace pleat {
namespace {

constexpr std::size_t kChainsOfSet = Float4::kLanes;

int lane_of(int slot) { return slot % Float4::kLanes; }

class BendSetMaker {
 public:
  BendSetMaker(const std::vector<BendChain>& chains, const LaneLayout& layout) : layout_(layout) {
    for (const BendChain& chain : chains) {
      chain_slots_.emplace_back();
      for (const VertexId vertex : chain.vertices)
        chain_slots_.back().push_back(layout.places[static_cast<std::size_t>(vertex)].slot);
    }
    const std::vector<int> others = append_those_in_groups();
    count_beside();
    append_others(others);
  }

  BendSets result;

 private:
  const std::vector<int>& slots_of(int chain) const {
    return chain_slots_[static_cast<std::size_t>(chain)];
  }

  /// Returns the chains that are in no set.
  std::vector<int> append_those_in_groups() {
    std::map<std::vector<int>, std::vector<int>> by_groups;
    std::vector<int> others;
    for (std::size_t c = 0; c < chain_slots_.size(); ++c) {
      const std::vector<int>& slots = chain_slots_[c];
      const int lane = lane_of(slots.front());
      const bool keeps_lane =
          std::all_of(slots.begin(), slots.end(), [&](int slot) { return lane_of(slot) == lane; });
      std::vector<int> groups;
      for (const int slot : slots) groups.push_back(slot - lane);
      if (keeps_lane)
        by_groups[groups].push_back(static_cast<int>(c));
      else
        others.push_back(static_cast<int>(c));
    }
    for (const auto& [groups, chains] : by_groups) {
      if (chains.size() > 1 && chains.size() <= kChainsOfSet)
        append(chains, true);
      else
        others.insert(others.end(), chains.begin(), chains.end());
    }
    return others;
  }

  void count_beside() {
    std::vector<BendSet>& sets = result.sets;
    for (std::size_t i = 0; i < sets.size(); ++i) {
      const int* const slots = result.slots.data() + sets[i].first_slot;
      const auto is_beside = [&](std::size_t other) {
        const int* const others = result.slots.data() + sets[other].first_slot;
        const int further = Float4::kLanes * static_cast<int>(other - i);
        for (int place = 0; place < sets[i].n_bends + 2; ++place)
          if (others[place] != slots[place] + further) return false;
        return true;
      };
      while (sets[i].n_beside < 3) {
        const std::size_t other = i + static_cast<std::size_t>(sets[i].n_beside) + 1;
        if (other >= sets.size() || sets[other].n_bends != sets[i].n_bends || !is_beside(other))
          break;
        ++sets[i].n_beside;
      }
    }
  }

  void append_others(std::vector<int> chains) {
    constexpr double kLongestOverShortest = 1.25;
    const auto length_of = [this](int chain) { return slots_of(chain).size(); };
    std::sort(chains.begin(), chains.end(), [&](int a, int b) {
      return std::make_pair(length_of(a), a) < std::make_pair(length_of(b), b);
    });
    std::vector<std::size_t> last_set(static_cast<std::size_t>(layout_.n_slots), 0);
    std::vector<int> together;
    for (const int chain : chains) {
      const auto is_in_set = [&](int slot) {
        return last_set[static_cast<std::size_t>(slot)] == result.sets.size() + 1;
      };
      const bool fits = together.size() < kChainsOfSet &&
                        std::none_of(slots_of(chain).begin(), slots_of(chain).end(), is_in_set) &&
                        (together.empty() ||
                         static_cast<double>(length_of(chain)) <=
                             kLongestOverShortest * static_cast<double>(length_of(together[0])));
      if (!fits) {
        append(together, false);
        together.clear();
      }
      together.push_back(chain);
      for (const int slot : slots_of(chain))
        last_set[static_cast<std::size_t>(slot)] = result.sets.size() + 1;
    }
    if (!together.empty()) append(together, false);
  }

  void append(const std::vector<int>& chains, bool in_groups) {
    constexpr int kPadding = 0;
    BendSet set;
    set.in_groups = in_groups;
    set.first_slot = static_cast<int>(result.slots.size());
    set.first_multiplier = n_multipliers_;
    std::size_t n_places = 0;
    for (std::size_t i = 0; i < chains.size(); ++i) {
      const std::vector<int>& slots = slots_of(chains[i]);
      const int lane = in_groups ? lane_of(slots[0]) : static_cast<int>(i);
      set.chains[static_cast<std::size_t>(lane)] = chains[i];
      n_places = std::max(n_places, slots.size());
    }
    set.n_bends = static_cast<int>(n_places) - 2;
    n_multipliers_ += set.n_bends * 3 * Float4::kLanes;
    for (std::size_t place = 0; place < n_places; ++place) {
      if (in_groups) {
        const int slot = slots_of(chains[0])[place];
        result.slots.push_back(slot - lane_of(slot));
        continue;
      }
      for (const int chain : set.chains) {
        const bool has_vertex = chain >= 0 && place < slots_of(chain).size();
        result.slots.push_back(has_vertex ? slots_of(chain)[place] : kPadding);
      }
    }
    set.stride = stride_of(set);
    result.sets.push_back(set);
  }

  /// Four rows that begin with the first piece of each: place p is lane p / stride of group p mod
  /// stride.
  int stride_of(const BendSet& set) const {
    if (set.in_groups || set.n_bends + 2 > layout_.row_slots()) return 0;
    const int* const slots = result.slots.data() + set.first_slot;
    for (int place = 0; place < set.n_bends + 2; ++place)
      for (int row = 0; row < Float4::kLanes; ++row) {
        if (set.chains[static_cast<std::size_t>(row)] < 0) continue;
        const int first = slots[row];
        const int expected =
            first + Float4::kLanes * (place % layout_.stride) + place / layout_.stride;
        const bool is_first_piece = lane_of(first) == 0 && first > 0;
        if (!is_first_piece || slots[Float4::kLanes * place + row] != expected) return 0;
      }
    return layout_.stride;
  }

  const LaneLayout& layout_;
  std::vector<std::vector<int>> chain_slots_;
  int n_multipliers_ = 0;
};

}  // namespace

BendSets bend_sets(const std::vector<BendChain>& chains, const LaneLayout& layout) {
  return BendSetMaker(chains, layout).result;
}

}  // namespace pleat
