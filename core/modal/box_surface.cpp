#include "core/modal/box_surface.h"

#include <cmath>
#include <map>
#include <string>

#include "core/base/check.h"

namespace pleat {
namespace {

using GridPoint = std::array<int, 3>;  // steps along x, y and z

/// Gives each point that is named a number, in the order in which they come.
class NumberedPoints {
 public:
  VertexId id(const GridPoint& point) {
    const auto [found, is_new] = ids_.emplace(point, static_cast<int>(ids_.size()));
    if (is_new) in_order_.push_back(point);
    return VertexId(found->second);
  }
  const std::vector<GridPoint>& in_order() const { return in_order_; }

 private:
  std::map<GridPoint, int> ids_;
  std::vector<GridPoint> in_order_;
};

GridPoint counts_of(const Vec3& sides, int cells) {
  if (!(sides.minCoeff() > 0) || !sides.allFinite())
    throw InputError("/sides_m", "expected three positive lengths");
  if (cells < 1)
    throw InputError("/cells", "expected one cell or more, found " + std::to_string(cells));
  const Vec3 wanted = sides * (cells / sides.minCoeff());
  if (2 * (wanted[0] * wanted[1] + wanted[1] * wanted[2] + wanted[2] * wanted[0]) > kMaxVertices)
    throw InputError("/cells", "expected at most " + std::to_string(kMaxVertices) + " vertices");
  GridPoint counts;
  for (int axis = 0; axis < 3; ++axis)
    counts[static_cast<std::size_t>(axis)] = static_cast<int>(std::lround(wanted[axis]));
  return counts;
}

/// Both faces across an axis.
void add_faces(const GridPoint& counts, std::size_t axis, NumberedPoints& points,
               std::vector<Triangle>& triangles) {
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  for (const bool is_far : {false, true})
    for (int i = 0; i < counts[u]; ++i)
      for (int j = 0; j < counts[v]; ++j) {
        const auto at = [&](int di, int dj) {
          GridPoint point;
          point[axis] = is_far ? counts[axis] : 0;
          point[u] = i + di;
          point[v] = j + dj;
          return points.id(point);
        };
        const VertexId a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
        if (is_far) {
          triangles.push_back({a, b, c});
          triangles.push_back({a, c, d});
        } else {
          triangles.push_back({a, c, b});
          triangles.push_back({a, d, c});
        }
      }
}

}  // namespace

BoxSurface box_surface(const Vec3& sides, int cells) {
  const GridPoint counts = counts_of(sides, cells);
  BoxSurface box;
  NumberedPoints points;
  for (std::size_t axis = 0; axis < 3; ++axis) add_faces(counts, axis, points, box.triangles);
  box.positions.resize(3, static_cast<Eigen::Index>(points.in_order().size()));
  Eigen::Index column = 0;
  for (const GridPoint& point : points.in_order()) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto row = static_cast<Eigen::Index>(axis);
      box.positions(row, column) = (double(point[axis]) / counts[axis] - 0.5) * sides[row];
    }
    ++column;
  }
  return box;
}

}  // namespace pleat
