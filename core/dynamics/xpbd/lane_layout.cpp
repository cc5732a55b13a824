#include "core/dynamics/xpbd/lane_layout.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/dynamics/xpbd/simd4.h"

namespace pleat {
namespace {

/// A piece of fewer columns would lie within one shifted group of its neighbour.
constexpr int kSmallestStride = 3;
/// Rest coordinates closer than this share of the extent are the same row.
constexpr double kRowTolerance = 1e-6;
/// With more places per vertex than this the rows are no grid: padding would cost more than it
/// saves. Small sheets are mostly padding and may be so.
constexpr double kMostPlacesPerVertex = 3;
constexpr int kSmallSheet = 256;

using Rows = std::vector<std::vector<int>>;

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

Rows grid_rows(const ClothModel& model) {
  const std::vector<Eigen::Vector2d> at = row_coordinates(model);
  std::vector<int> order(at.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return at[i].x() < at[j].x(); });
  const double tolerance = kRowTolerance * (at[order.back()].x() - at[order.front()].x());
  Rows rows;
  for (int vertex : order) {
    if (rows.empty() || at[vertex].x() > at[rows.back().front()].x() + tolerance)
      rows.emplace_back();
    rows.back().push_back(vertex);
  }
  for (std::vector<int>& row : rows)
    std::stable_sort(row.begin(), row.end(), [&](int i, int j) { return at[i].y() < at[j].y(); });
  return rows;
}

Rows one_row(int n_vertices) {
  Rows rows(1, std::vector<int>(static_cast<std::size_t>(n_vertices)));
  std::iota(rows[0].begin(), rows[0].end(), 0);
  return rows;
}

int stride_of(const Rows& rows) {
  std::size_t longest = 0;
  for (const std::vector<int>& row : rows) longest = std::max(longest, row.size());
  return std::max(kSmallestStride,
                  (static_cast<int>(longest) + Float4::kLanes - 1) / Float4::kLanes);
}

}  // namespace

LaneLayout lane_layout(const ClothModel& model) {
  const int n = model.n_vertices();
  Rows rows = model.rest_coordinates.cols() == n ? grid_rows(model) : one_row(n);
  const double places = static_cast<double>(rows.size()) * Float4::kLanes * stride_of(rows);
  if (n > kSmallSheet && places > kMostPlacesPerVertex * n) rows = one_row(n);

  LaneLayout layout;
  layout.stride = stride_of(rows);
  layout.places.resize(static_cast<std::size_t>(n));
  const int row_slots = Float4::kLanes * layout.stride;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      const int row = static_cast<int>(r);
      const int column = static_cast<int>(c);
      const int slot = Float4::kLanes + row * row_slots +
                       Float4::kLanes * (column % layout.stride) + column / layout.stride;
      layout.places[static_cast<std::size_t>(rows[r][c])] = {row, column, slot};
    }
  }
  layout.n_rows = static_cast<int>(rows.size());
  layout.n_slots = layout.n_rows * row_slots + 2 * Float4::kLanes;
  return layout;
}

}  // namespace pleat
