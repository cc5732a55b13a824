#include "native-tests/support/bars.h"

#include <cmath>

#include "core/mesh/triangle_mesh.h"

namespace pleat {

Positions box_corners(const Vec3& sides) {
  Positions corners(3, 8);
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 3; ++k) corners(k, i) = ((i >> k & 1) - 0.5) * sides[k];
  return corners;
}

std::vector<Triangle> box_triangles() {
  constexpr int kSides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  std::vector<Triangle> triangles;
  for (const auto& side : kSides) {
    triangles.push_back({VertexId(side[0]), VertexId(side[1]), VertexId(side[2])});
    triangles.push_back({VertexId(side[0]), VertexId(side[2]), VertexId(side[3])});
  }
  return triangles;
}

FineBox::FineBox(const Vec3& sides, int levels) {
  TriangleMesh mesh;
  mesh.rest_positions = box_corners(sides);
  mesh.triangles = box_triangles();
  mesh.warp_directions.assign(mesh.triangles.size(), Vec3(1, 0, 0));
  mesh = subdivided(std::move(mesh), levels);
  positions = mesh.rest_positions;
  triangles = mesh.triangles;
}

Positions bent(const Positions& straight, double angle) {
  const double length = straight.row(0).maxCoeff() - straight.row(0).minCoeff();
  const double radius = length / angle;
  Positions result = straight;
  for (Eigen::Index v = 0; v < straight.cols(); ++v) {
    const double turn = straight(0, v) / radius;
    result(0, v) = (radius - straight(1, v)) * std::sin(turn);
    result(1, v) = radius - (radius - straight(1, v)) * std::cos(turn);
  }
  return result;
}

CarryingVolume bar_volume(const Vec3& sides, double edge) {
  return lattice_volume(box_corners(sides), box_triangles(), edge);
}

}  // namespace pleat
