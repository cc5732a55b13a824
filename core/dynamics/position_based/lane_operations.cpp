#include "core/dynamics/position_based/lane_operations.h"

namespace pleat {
namespace {

/// True where no two of the groups overlap.
bool are_apart(const std::array<int, 3>& first_slots, int n_groups) {
  for (int i = 0; i < n_groups; ++i)
    for (int j = 0; j < i; ++j)
      if (std::abs(first_slots[static_cast<std::size_t>(i)] -
                   first_slots[static_cast<std::size_t>(j)]) < Float4::kLanes)
        return false;
  return true;
}

}  // namespace

std::vector<LaneOperation> compile_operations(std::vector<LaneCandidate> candidates) {
  std::sort(candidates.begin(), candidates.end(),
            [](const LaneCandidate& p, const LaneCandidate& q) {
              return std::tie(p.first_slots, p.lane, p.element) <
                     std::tie(q.first_slots, q.lane, q.element);
            });
  std::vector<std::pair<std::size_t, std::size_t>> groups;  // ranges [from, to) of candidates
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const bool joins = i > 0 && candidates[i].first_slots == candidates[i - 1].first_slots &&
                       candidates[i].lane > candidates[i - 1].lane;
    if (!joins) groups.emplace_back(i, i);
    groups.back().second = i + 1;
  }
  std::sort(groups.begin(), groups.end(), [&](const auto& p, const auto& q) {
    const LaneCandidate& a = candidates[p.first];
    const LaneCandidate& b = candidates[q.first];
    return std::tie(a.rank, a.first_slots, a.element) < std::tie(b.rank, b.first_slots, b.element);
  });
  std::vector<LaneOperation> operations;
  for (const auto& [from, to] : groups) {
    operations.push_back({candidates[from].first_slots, kNoMembers});
    for (std::size_t i = from; i < to; ++i)
      operations.back().members[static_cast<std::size_t>(candidates[i].lane)] =
          candidates[i].element;
  }
  return operations;
}

void append_to_stretches(std::vector<OperationStretch>& stretches, int index,
                         const std::array<int, 3>& first_slots, int n_groups) {
  const bool whole = are_apart(first_slots, n_groups);
  if (stretches.empty() || stretches.back().whole != whole || stretches.back().end != index)
    stretches.push_back({index, index, whole});
  stretches.back().end = index + 1;
}

}  // namespace pleat
