#include "native-tests/support/bodies.h"

#include <algorithm>

namespace pleat {

BodySurface ball_body(double radius, int levels) {
  TriangleMesh mesh;
  mesh.rest_positions.resize(3, 6);
  mesh.rest_positions << 1, -1, 0, 0, 0, 0, 0, 0, 1, -1, 0, 0, 0, 0, 0, 0, 1, -1;
  for (const int x : {0, 1})
    for (const int y : {2, 3})
      for (const int z : {4, 5}) {
        const bool is_even = (x + y + z) % 2 == 0;
        mesh.triangles.push_back(
            {VertexId(x), VertexId(is_even ? y : z), VertexId(is_even ? z : y)});
        mesh.warp_directions.emplace_back(0, 0, 0);
      }
  BodySurface ball;
  mesh = subdivided(std::move(mesh), levels);
  ball.places = radius * mesh.rest_positions.colwise().normalized();
  ball.triangles = mesh.triangles;
  return ball;
}

double height_above_box(const Vec3& size, const Vec3& place) {
  const Vec3 beyond = place.cwiseAbs() - size / 2;
  if (beyond.maxCoeff() <= 0) return beyond.maxCoeff();
  return beyond.cwiseMax(0).norm();
}

}  // namespace pleat
