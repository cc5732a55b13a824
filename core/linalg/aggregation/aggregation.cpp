#include "core/linalg/aggregation/aggregation.h"

#include <cstddef>
#include <utility>

namespace pleat {
namespace {

class Grouping {
 public:
  Grouping(const LowerPattern& graph, int size)
      : graph_(graph),
        size_(size),
        groups_(static_cast<std::size_t>(graph.n_rows()), -1),
        n_inside_(groups_.size(), 0) {}

  Aggregates found() && {
    for (int node = 0; node < graph_.n_rows(); ++node)
      if (group(node) < 0 && has_edge(node)) grow(node);
    join_small();
    return numbered();
  }

 private:
  int& group(int node) { return groups_[place(node)]; }

  bool has_edge(int node) const {
    return graph_.begins[place(node)] < graph_.begins[place(node) + 1] ||
           graph_.column_begins[place(node)] < graph_.column_begins[place(node) + 1];
  }

  template <class Work>
  void for_each_neighbour(int node, const Work& work) const {
    for (int k = graph_.begins[place(node)]; k < graph_.begins[place(node) + 1]; ++k)
      work(graph_.columns[place(k)]);
    for (int k = graph_.column_begins[place(node)]; k < graph_.column_begins[place(node) + 1]; ++k)
      work(graph_.column_rows[place(k)]);
  }

  void grow(int start) {
    const int own = static_cast<int>(members_.size());
    members_.emplace_back();
    waiting_.clear();
    for (int taken = start; taken >= 0;) {
      group(taken) = own;
      members_.back().push_back(taken);
      for_each_neighbour(taken, [this](int node) {
        if (group(node) < 0 && n_inside_[place(node)]++ == 0) waiting_.push_back(node);
      });
      taken = -1;
      if (static_cast<int>(members_.back().size()) == size_) break;
      for (const int node : waiting_)
        if (group(node) < 0 && (taken < 0 || n_inside_[place(node)] > n_inside_[place(taken)]))
          taken = node;
    }
    for (const int node : waiting_) n_inside_[place(node)] = 0;
  }

  void join_small() {
    std::vector<int> n_edges(members_.size(), 0);  // number of edges to each group
    for (std::size_t small = 0; small < members_.size(); ++small) {
      std::vector<int>& own = members_[small];
      if (2 * static_cast<int>(own.size()) >= size_) continue;
      int best = -1;
      waiting_.clear();
      for (const int node : own) {
        for_each_neighbour(node, [&](int neighbour) {
          const int other = group(neighbour);
          if (other == static_cast<int>(small)) return;
          waiting_.push_back(other);
          ++n_edges[place(other)];
          if (best < 0 || n_edges[place(other)] > n_edges[place(best)]) best = other;
        });
      }
      for (const int other : waiting_) n_edges[place(other)] = 0;
      if (best < 0) continue;
      for (const int node : own) {
        group(node) = best;
        members_[place(best)].push_back(node);
      }
      own.clear();
    }
  }

  Aggregates numbered() {
    Aggregates found;
    std::vector<int> numbers(members_.size(), -1);
    for (std::size_t k = 0; k < members_.size(); ++k)
      if (!members_[k].empty()) numbers[k] = found.count++;
    for (int& group : groups_)
      if (group >= 0) group = numbers[place(group)];
    found.of_node = std::move(groups_);
    return found;
  }

  const LowerPattern& graph_;
  int size_;
  std::vector<int> groups_;                // group of each node, or -1
  std::vector<std::vector<int>> members_;  // members of each group
  std::vector<int> n_inside_;              // neighbours in the group that grows
  std::vector<int> waiting_;
};

}  // namespace

Aggregates aggregate(const LowerPattern& graph, int size) { return Grouping(graph, size).found(); }

}  // namespace pleat
