#include "core/error/material_map.h"

#include <algorithm>
#include <cmath>

#include "core/mesh/triangle_tree.h"

namespace pleat {

MaterialMap::MaterialMap(const TriangleMesh& mesh, const PositionsView& points) {
  const std::vector<Corners> corners = triangle_corners(mesh.triangles, mesh.rest_positions);
  TriangleTree tree(corners);
  places_.reserve(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const auto [triangle, distance_squared] = tree.nearest(points.col(i));
    places_.push_back(
        {mesh.triangles[triangle], nearest_weights(points.col(i), corners[triangle])});
    farthest_ = std::max(farthest_, std::sqrt(distance_squared));
  }
}

Positions MaterialMap::of(const PositionsView& positions) const {
  Positions result(3, static_cast<Eigen::Index>(places_.size()));
  Eigen::Index column = 0;
  for (const Place& place : places_) {
    const Triangle& t = place.triangle;
    result.col(column++) = place.weights[0] * positions.col(t[0]) +
                           place.weights[1] * positions.col(t[1]) +
                           place.weights[2] * positions.col(t[2]);
  }
  return result;
}

Positions MaterialMap::normals_of(const PositionsView& positions) const {
  Positions normals(3, static_cast<Eigen::Index>(places_.size()));
  Eigen::Index column = 0;
  for (const Place& place : places_) {
    const Triangle& t = place.triangle;
    const Vec3 along = positions.col(t[1]) - positions.col(t[0]);
    normals.col(column++) = along.cross(Vec3(positions.col(t[2]) - positions.col(t[0])));
  }
  return normals;
}

}  // namespace pleat
