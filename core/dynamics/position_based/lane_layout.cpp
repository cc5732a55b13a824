#include "core/dynamics/position_based/lane_layout.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/simd.h"
#include "core/dynamics/position_based/thread_grid.h"

namespace pleat {
namespace {

/// A piece of fewer columns would lie within one shifted group of its neighbour.
constexpr int kSmallestStride = 3;
/// Rest coordinates closer than this share of the extent are the same row.
constexpr double kRowTolerance = 1e-6;
/// Rows with more places per vertex than this are no grid: padding would cost more than it
/// saves. Small sheets are mostly padding and may be so.
constexpr double kMostPlacesPerVertex = 3;
constexpr int kSmallSheet = 256;

using Grid = std::vector<GridPlace>;

/// Rest coordinates turned so that .x() grows away from the pins and .y() runs along the rows.
std::vector<Eigen::Vector2d> row_coordinates(const ClothModel& model) {
  const RestCoordinates& rest = model.rest_coordinates;
  const Eigen::Vector2d low = rest.rowwise().minCoeff();
  const Eigen::Vector2d half = 0.5 * (rest.rowwise().maxCoeff() - low);
  Eigen::Vector2d pins(0, 0);  // mean place of the pins, from -1 to 1
  for (const Pin& pin : model.pins)
    for (int axis = 0; axis < 2; ++axis)
      if (half[axis] > 0)
        pins[axis] += (rest(axis, pin.vertex.value) - low[axis] - half[axis]) /
                      (half[axis] * static_cast<double>(model.pins.size()));
  const int axis = std::abs(pins[1]) > std::abs(pins[0]) ? 1 : 0;
  const double sign = pins[axis] > 0 ? -1 : 1;
  std::vector<Eigen::Vector2d> coordinates(static_cast<std::size_t>(rest.cols()));
  for (Eigen::Index i = 0; i < rest.cols(); ++i)
    coordinates[static_cast<std::size_t>(i)] = {sign * rest(axis, i), rest(1 - axis, i)};
  return coordinates;
}

Grid sheet_grid(const ClothModel& model) {
  const std::vector<Eigen::Vector2d> at = row_coordinates(model);
  std::vector<int> order(at.size());
  std::iota(order.begin(), order.end(), 0);
  const auto sort_by = [&](int axis, std::vector<int>& vertices) {
    std::stable_sort(vertices.begin(), vertices.end(),
                     [&](int i, int j) { return at[i][axis] < at[j][axis]; });
  };
  sort_by(0, order);
  const double tolerance = kRowTolerance * (at[order.back()].x() - at[order.front()].x());
  std::vector<std::vector<int>> rows;
  for (int vertex : order) {
    if (rows.empty() || at[vertex].x() > at[rows.back().front()].x() + tolerance)
      rows.emplace_back();
    rows.back().push_back(vertex);
  }
  Grid grid(at.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::vector<int>& row = rows[r];
    sort_by(1, row);
    for (std::size_t c = 0; c < row.size(); ++c)
      grid[static_cast<std::size_t>(row[c])] = {static_cast<int>(r), static_cast<int>(c)};
  }
  return grid;
}

/// True where no thread joins places of a row that are not side by side.
bool is_flat(const ClothModel& model, const Grid& grid) {
  return std::none_of(model.springs.begin(), model.springs.end(), [&](const Spring& spring) {
    const GridPlace& a = grid[static_cast<std::size_t>(spring.a)];
    const GridPlace& b = grid[static_cast<std::size_t>(spring.b)];
    const bool is_thread = spring.kind == SpringKind::warp || spring.kind == SpringKind::weft;
    return is_thread && a.row == b.row && std::abs(a.column - b.column) > 1;
  });
}

Grid one_row(int n_vertices) {
  Grid grid(static_cast<std::size_t>(n_vertices));
  for (std::size_t v = 0; v < grid.size(); ++v) grid[v].column = static_cast<int>(v);
  return grid;
}

/// How many rows and columns there are.
GridPlace extent_of(const Grid& grid) {
  GridPlace extent;
  for (const GridPlace& place : grid) {
    extent.row = std::max(extent.row, place.row + 1);
    extent.column = std::max(extent.column, place.column + 1);
  }
  return extent;
}

int stride_of(const GridPlace& extent) {
  return std::max(kSmallestStride, (extent.column + Float4::kLanes - 1) / Float4::kLanes);
}

bool fills_its_places(const Grid& grid) {
  const auto n = static_cast<int>(grid.size());
  const GridPlace extent = extent_of(grid);
  const double places = static_cast<double>(extent.row) * Float4::kLanes * stride_of(extent);
  return n <= kSmallSheet || places <= kMostPlacesPerVertex * n;
}

Grid grid_of(const ClothModel& model) {
  const int n = model.n_vertices();
  Grid sheet;
  if (model.rest_coordinates.cols() == n) sheet = sheet_grid(model);
  if (!sheet.empty() && is_flat(model, sheet) && fills_its_places(sheet)) return sheet;
  std::optional<Grid> threads = thread_grid(model);
  if (threads && fills_its_places(*threads)) return *std::move(threads);
  return !sheet.empty() && fills_its_places(sheet) ? sheet : one_row(n);
}

}  // namespace

LaneLayout lane_layout(const ClothModel& model) {
  const Grid grid = grid_of(model);
  const GridPlace extent = extent_of(grid);
  LaneLayout layout;
  layout.stride = stride_of(extent);
  layout.n_rows = extent.row;
  const int row_slots = Float4::kLanes * layout.stride;
  for (const auto& [row, column] : grid)
    layout.places.push_back({row, column,
                             Float4::kLanes + row * row_slots +
                                 Float4::kLanes * (column % layout.stride) +
                                 column / layout.stride});
  layout.n_slots = layout.n_rows * row_slots + 2 * Float4::kLanes;
  return layout;
}

}  // namespace pleat
