#pragma once

#include <vector>

namespace pleat {

/// Sets of numbers from 0 that are joined two by two; each is known by its smallest member.
class JoinedSets {
 public:
  explicit JoinedSets(std::size_t n);

  void join(int a, int b);
  /// The number of each member's set, from 0 in the order of their smallest members.
  std::vector<int> numbers();

 private:
  int root(int i);

  std::vector<int> parent_;
};

}  // namespace pleat
