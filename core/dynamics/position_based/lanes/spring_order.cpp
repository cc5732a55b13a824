#include "core/dynamics/position_based/lanes/spring_order.h"

#include <algorithm>
#include <cstdlib>

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

/// True where a spring joins the ends of every row.
bool closes_to_a_tube(const ClothModel& model, const LaneLayout& layout) {
  std::vector<int> last(static_cast<std::size_t>(layout.n_rows), 0);
  for (const auto& [row, column, slot] : layout.places) {
    int& known = last[static_cast<std::size_t>(row)];
    known = std::max(known, column);
  }
  std::vector<bool> is_open(last.size(), true);
  for (const Spring& spring : model.springs) {
    const LaneLayout::Place& a = layout.places[static_cast<std::size_t>(spring.a)];
    const LaneLayout::Place& b = layout.places[static_cast<std::size_t>(spring.b)];
    const auto row = static_cast<std::size_t>(a.row);
    if (a.row == b.row && last[row] > 1 && std::abs(a.column - b.column) == last[row])
      is_open[row] = false;
  }
  return std::find(is_open.begin(), is_open.end(), true) == is_open.end();
}

/// Chains of operations that are so many slots apart and stay in their lanes, each as indices from
/// end to end. Where two springs join the same vertices, only one of them is in a chain.
std::vector<std::vector<int>> chains_of(const std::vector<LaneOperation>& operations,
                                        const LaneLayout& layout, int step) {
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
  const auto take_lines = [&](int step) {
    for (const std::vector<int>& chain : chains_of(operations, layout, step)) {
      order.lines.push_back(
          {static_cast<int>(order.operations.size()), static_cast<int>(chain.size())});
      for (int i : chain) {
        order.operations.push_back(operations[static_cast<std::size_t>(i)]);
        is_taken[static_cast<std::size_t>(i)] = true;
      }
    }
  };
  if (layout.n_rows > 1) take_lines(layout.row_slots());
  if (layout.n_rows == 1 || closes_to_a_tube(model, layout)) take_lines(Float4::kLanes);
  for (std::size_t i = 0; i < operations.size(); ++i)
    if (!is_taken[i]) order.operations.push_back(operations[i]);
  return order;
}

}  // namespace pleat
