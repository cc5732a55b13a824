#include "core/base/joined_sets.h"

#include <algorithm>
#include <numeric>

namespace pleat {

JoinedSets::JoinedSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

void JoinedSets::join(int a, int b) {
  a = root(a);
  b = root(b);
  parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
}

std::vector<int> JoinedSets::numbers() {
  std::vector<int> numbers(parent_.size(), -1);
  int n_sets = 0;
  for (std::size_t i = 0; i < parent_.size(); ++i) {
    const auto first = static_cast<std::size_t>(root(static_cast<int>(i)));
    if (numbers[first] < 0) numbers[first] = n_sets++;
    numbers[i] = numbers[first];
  }
  return numbers;
}

int JoinedSets::root(int i) {
  while (parent_[static_cast<std::size_t>(i)] != i) {
    int& up = parent_[static_cast<std::size_t>(i)];
    up = parent_[static_cast<std::size_t>(up)];
    i = up;
  }
  return i;
}

}  // namespace pleat
