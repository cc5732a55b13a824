#include "core/dynamics/position_based/levels/independent_sets.h"

#include <cstddef>

namespace pleat {

std::vector<std::vector<int>> independent_sets(const std::vector<PlacePair>& elements,
                                               const std::vector<bool>& moves) {
  std::vector<std::vector<int>> sets;
  std::vector<std::vector<bool>> is_taken(moves.size());  // sets that have each place
  const auto is_free = [&](int place, std::size_t set) {
    const std::vector<bool>& taken = is_taken[static_cast<std::size_t>(place)];
    return !moves[static_cast<std::size_t>(place)] || set >= taken.size() || !taken[set];
  };
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto [a, b] = elements[e];
    std::size_t set = 0;
    while (!is_free(a, set) || !is_free(b, set)) ++set;
    if (set >= sets.size()) sets.resize(set + 1);
    sets[set].push_back(static_cast<int>(e));
    for (const int place : {a, b}) {
      std::vector<bool>& taken = is_taken[static_cast<std::size_t>(place)];
      if (set >= taken.size()) taken.resize(set + 1, false);
      taken[set] = true;
    }
  }
  return sets;
}

}  // namespace pleat
