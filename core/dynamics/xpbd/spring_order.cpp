#include "core/dynamics/xpbd/spring_order.h"

namespace pleat {
namespace {

constexpr int kNone = -1;

/// Diagonals first, then along the rows, then across them (as far as those are in no line), where
/// each of these may look only a few rows ahead: the order is the same as with three passes over
/// the cloth, but a row is still in the cache when it is needed again. Within a pair of rows the
/// diagonals of every second column come first, so that none waits for its neighbour.
std::array<int, 5> rank_of(const LaneLayout& layout, const LaneLayout::Place& a,
                           const LaneLayout::Place& b) {
  const int column = std::min(a.column, b.column) % layout.stride;
  if (a.row == b.row) return {a.row / kPanelRows, 1, column, a.row, 0};
  if (a.column == b.column) return {b.row / kPanelRows, 2, a.row, column, 0};
  return {a.row / kPanelRows, 0, a.row, column % 2, column};
}

/// Chains of operations that stay in their lanes, each as indices from end to end. Where two
/// springs join the same vertices, only one of them is in a chain.
std::vector<std::vector<int>> chains_of(const std::vector<LaneOperation>& operations,
                                        const LaneLayout& layout) {
  const int step = layout.n_rows > 1 ? layout.row_slots() : Float4::kLanes;
  std::vector<int> from(static_cast<std::size_t>(layout.n_slots), kNone);
  std::vector<bool> is_reached(static_cast<std::size_t>(layout.n_slots), false);
  for (std::size_t i = 0; i < operations.size(); ++i) {
    const auto [a, b, unused] = operations[i].first_slots;
    if (a % Float4::kLanes != 0 || b - a != step || from[static_cast<std::size_t>(a)] != kNone)
      continue;
    from[static_cast<std::size_t>(a)] = static_cast<int>(i);
    is_reached[static_cast<std::size_t>(b)] = true;
  }
  std::vector<std::vector<int>> chains;
  for (std::size_t slot = 0; slot < from.size(); ++slot) {
    if (from[slot] == kNone || is_reached[slot]) continue;
    std::vector<int> chain;
    for (std::size_t at = slot; from[at] != kNone; at += static_cast<std::size_t>(step))
      chain.push_back(from[at]);
    if (chain.size() > 1) chains.push_back(std::move(chain));
  }
  return chains;
}

}  // namespace

SpringOrder order_springs(const ClothModel& model, const LaneLayout& layout,
                          const std::vector<int>& springs) {
  std::vector<LaneCandidate> candidates;
  for (int s : springs) {
    const Spring& spring = model.springs[static_cast<std::size_t>(s)];
    const LaneLayout::Place* a = &layout.places[static_cast<std::size_t>(spring.a)];
    const LaneLayout::Place* b = &layout.places[static_cast<std::size_t>(spring.b)];
    if (std::tie(b->row, b->column) < std::tie(a->row, a->column)) std::swap(a, b);
    const int lane = a->slot % Float4::kLanes;
    candidates.push_back({{a->slot - lane, b->slot - lane, 0}, lane, s, rank_of(layout, *a, *b)});
  }
  const std::vector<LaneOperation> operations = compile_operations(std::move(candidates));

  SpringOrder order;
  std::vector<bool> is_taken(operations.size(), false);
  for (const std::vector<int>& chain : chains_of(operations, layout)) {
    order.lines.push_back(
        {static_cast<int>(order.operations.size()), static_cast<int>(chain.size())});
    for (int i : chain) {
      order.operations.push_back(operations[static_cast<std::size_t>(i)]);
      is_taken[static_cast<std::size_t>(i)] = true;
    }
  }
  for (std::size_t i = 0; i < operations.size(); ++i)
    if (!is_taken[i]) order.operations.push_back(operations[i]);
  return order;
}

}  // namespace pleat
