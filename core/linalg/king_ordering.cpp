#include "core/linalg/king_ordering.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace pleat {
namespace {

class KingOrdering {
 public:
  explicit KingOrdering(const std::vector<std::vector<int>>& neighbours)
      : neighbours_(neighbours), reached_(neighbours.size(), 0) {
    for (const std::vector<int>& nodes : neighbours)
      n_unreached_.push_back(static_cast<int>(nodes.size()));
  }

  std::vector<int> order() && {
    const int n = static_cast<int>(neighbours_.size());
    for (int node = 0; node < n; ++node)
      if (reached_[place(node)] != kTaken) take_component(last_from(last_from(node)));
    std::reverse(order_.begin(), order_.end());
    return std::move(order_);
  }

 private:
  static constexpr int kTaken = -1;

  static std::size_t place(int node) { return static_cast<std::size_t>(node); }

  /// The last node that a breadth first search comes to, as far away as any.
  int last_from(int start) {
    ++search_;
    std::vector<int> queue = {start};
    reached_[place(start)] = search_;
    for (std::size_t next = 0; next < queue.size(); ++next) {
      for (const int node : neighbours_[place(queue[next])]) {
        if (reached_[place(node)] == search_) continue;
        reached_[place(node)] = search_;
        queue.push_back(node);
      }
    }
    return queue.back();
  }

  void reach(int node) {
    reached_[place(node)] = kTaken;
    front_.push_back(node);
    for (const int other : neighbours_[place(node)]) --n_unreached_[place(other)];
  }

  void take_component(int start) {
    reach(start);
    while (!front_.empty()) {
      const auto next = std::min_element(front_.begin(), front_.end(), [this](int a, int b) {
        return n_unreached_[place(a)] < n_unreached_[place(b)];
      });
      const int node = *next;
      front_.erase(next);
      order_.push_back(node);
      for (const int other : neighbours_[place(node)])
        if (reached_[place(other)] != kTaken) reach(other);
    }
  }

  const std::vector<std::vector<int>>& neighbours_;
  std::vector<int> n_unreached_;  // neighbours of each node
  std::vector<int> reached_;      // search that reached each node, or kTaken into the front
  int search_ = 0;
  std::vector<int> front_;  // reached, not yet in the order
  std::vector<int> order_;
};

}  // namespace

std::vector<int> reverse_king_ordering(const std::vector<std::vector<int>>& neighbours) {
  return KingOrdering(neighbours).order();
}

}  // namespace pleat
