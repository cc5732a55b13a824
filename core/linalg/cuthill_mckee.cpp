#include "core/linalg/cuthill_mckee.h"

#include <algorithm>

namespace pleat {
namespace {

/// Visits a component of a graph breadth first and appends its nodes.
class BreadthFirst {
 public:
  explicit BreadthFirst(const std::vector<std::vector<int>>& neighbours)
      : neighbours_(neighbours), last_visit_(neighbours.size(), 0) {}

  bool was_visited(int node) const { return last_visit_[static_cast<std::size_t>(node)] > 0; }

  void visit_from(int start, std::vector<int>& order) {
    ++visit_;
    const auto append = [&](int node) {
      last_visit_[static_cast<std::size_t>(node)] = visit_;
      order.push_back(node);
    };
    std::size_t next = order.size();
    append(start);
    for (; next < order.size(); ++next) {
      const std::size_t first = order.size();
      for (const int node : neighbours_[static_cast<std::size_t>(order[next])])
        if (last_visit_[static_cast<std::size_t>(node)] != visit_) append(node);
      std::sort(order.begin() + static_cast<std::ptrdiff_t>(first), order.end(), [&](int a, int b) {
        return degree(a) != degree(b) ? degree(a) < degree(b) : a < b;
      });
    }
  }

 private:
  std::size_t degree(int node) const { return neighbours_[static_cast<std::size_t>(node)].size(); }

  const std::vector<std::vector<int>>& neighbours_;
  std::vector<int> last_visit_;  // of each node; 0 before the first
  int visit_ = 0;
};

}  // namespace

std::vector<int> reverse_cuthill_mckee(const std::vector<std::vector<int>>& neighbours) {
  std::vector<int> order;
  BreadthFirst search(neighbours);
  const int n = static_cast<int>(neighbours.size());
  for (int node = 0; node < n; ++node) {
    if (search.was_visited(node)) continue;
    // The last node from anywhere is at the rim, the last from there at another end of it.
    const std::size_t begin = order.size();
    int start = node;
    for (int attempt = 0; attempt < 3; ++attempt) {
      order.resize(begin);
      search.visit_from(start, order);
      start = order.back();
    }
  }
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace pleat
