#include "core/dynamics/position_based/thread_grid.h"

#include <algorithm>
#include <array>

namespace pleat {
namespace {

constexpr int kNowhere = -1;

/// The vertices next to each along one kind of thread, two at most.
class ThreadNeighbours {
 public:
  ThreadNeighbours(const ClothModel& model, SpringKind kind)
      : of_(static_cast<std::size_t>(model.n_vertices()), {kNowhere, kNowhere}) {
    for (const Spring& spring : model.springs) {
      if (spring.kind != kind) continue;
      add(spring.a.value, spring.b.value);
      add(spring.b.value, spring.a.value);
    }
  }

  std::size_t size() const { return of_.size(); }
  bool branch() const { return branch_; }
  bool is_end(int vertex) const { return of_[static_cast<std::size_t>(vertex)][1] == kNowhere; }

  template <class Visit>
  void visit(int vertex, const Visit& visit) const {
    for (const int next : of_[static_cast<std::size_t>(vertex)])
      if (next != kNowhere) visit(next);
  }

 private:
  void add(int from, int to) {
    auto& two = of_[static_cast<std::size_t>(from)];
    branch_ = branch_ || two[1] != kNowhere;
    two[two[0] == kNowhere ? 0 : 1] = to;
  }

  std::vector<std::array<int, 2>> of_;
  bool branch_ = false;
};

/// All vertices, those first from which pieces of cloth are gone through: pinned ends of threads,
/// then other ends.
std::vector<int> beginnings(const ClothModel& model, const ThreadNeighbours& across) {
  std::vector<int> vertices;
  for (const Pin& pin : model.pins)
    if (across.is_end(pin.vertex.value)) vertices.push_back(pin.vertex.value);
  for (const bool ends : {true, false})
    for (int v = 0; v < model.n_vertices(); ++v)
      if (across.is_end(v) == ends) vertices.push_back(v);
  return vertices;
}

/// The fewest steps across rows from where each piece begins.
std::vector<int> rows_of(const std::vector<int>& beginnings, const ThreadNeighbours& across,
                         const ThreadNeighbours& along) {
  std::vector<int> rows(across.size(), kNowhere);
  for (const int begin : beginnings) {
    std::vector<int> front{begin};
    std::vector<int> after;
    for (int row = 0; !front.empty(); ++row) {
      while (!front.empty()) {
        const int vertex = front.back();
        front.pop_back();
        int& known = rows[static_cast<std::size_t>(vertex)];
        if (known != kNowhere) continue;
        known = row;
        along.visit(vertex, [&](int next) { front.push_back(next); });
        across.visit(vertex, [&](int next) { after.push_back(next); });
      }
      front.swap(after);
    }
  }
  return rows;
}

/// True where threads cross rows one by one, or follow within one.
bool is_grid(const std::vector<int>& rows, const ThreadNeighbours& across,
             const ThreadNeighbours& along) {
  bool fits = true;
  for (std::size_t v = 0; v < rows.size(); ++v) {
    int steps = 0;
    bool goes = false;
    const auto step_to = [&](int next) { return rows[static_cast<std::size_t>(next)] - rows[v]; };
    across.visit(static_cast<int>(v), [&](int next) {
      fits = fits && std::abs(step_to(next)) == 1 && !(goes && step_to(next) == steps);
      steps = step_to(next);
      goes = true;
    });
    along.visit(static_cast<int>(v), [&](int next) { fits = fits && step_to(next) == 0; });
  }
  return fits;
}

/// Numbers of the threads that cross the rows, from one to the next beside it while there is one.
std::vector<int> columns_of(const std::vector<int>& beginnings, const ThreadNeighbours& across,
                            const ThreadNeighbours& along) {
  std::vector<int> columns(across.size(), kNowhere);
  int n_columns = 0;
  std::vector<int> open(beginnings.rbegin(), beginnings.rend());
  while (!open.empty()) {
    std::vector<int> thread{open.back()};
    open.pop_back();
    if (columns[static_cast<std::size_t>(thread[0])] != kNowhere) continue;
    columns[static_cast<std::size_t>(thread[0])] = n_columns;
    for (std::size_t i = 0; i < thread.size(); ++i)
      across.visit(thread[i], [&](int next) {
        if (columns[static_cast<std::size_t>(next)] != kNowhere) return;
        columns[static_cast<std::size_t>(next)] = n_columns;
        thread.push_back(next);
      });
    ++n_columns;
    for (const int vertex : thread) along.visit(vertex, [&](int next) { open.push_back(next); });
  }
  return columns;
}

struct ThreadGrid {
  std::vector<GridPlace> places;
  double row_of_pins = 1;  ///< mean, in shares of the last row; 1 without pins
};

std::optional<ThreadGrid> grid_across(const ClothModel& model, SpringKind kind_across,
                                      SpringKind kind_along) {
  const ThreadNeighbours across(model, kind_across);
  const ThreadNeighbours along(model, kind_along);
  if (across.branch() || along.branch()) return std::nullopt;
  const std::vector<int> begin = beginnings(model, across);
  const std::vector<int> rows = rows_of(begin, across, along);
  const int last = *std::max_element(rows.begin(), rows.end());
  if (last == 0 || !is_grid(rows, across, along)) return std::nullopt;
  const std::vector<int> columns = columns_of(begin, across, along);
  ThreadGrid grid;
  for (std::size_t v = 0; v < rows.size(); ++v) grid.places.push_back({rows[v], columns[v]});
  if (model.pins.empty()) return grid;
  double sum = 0;
  for (const Pin& pin : model.pins) sum += rows[static_cast<std::size_t>(pin.vertex.value)];
  grid.row_of_pins = sum / (last * static_cast<double>(model.pins.size()));
  return grid;
}

}  // namespace

std::optional<std::vector<GridPlace>> thread_grid(const ClothModel& model) {
  std::optional<ThreadGrid> warp = grid_across(model, SpringKind::warp, SpringKind::weft);
  std::optional<ThreadGrid> weft = grid_across(model, SpringKind::weft, SpringKind::warp);
  if (warp && (!weft || warp->row_of_pins <= weft->row_of_pins)) return std::move(warp->places);
  if (weft) return std::move(weft->places);
  return std::nullopt;
}

}  // namespace pleat
