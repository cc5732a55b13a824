#include "core/contact/body_surface.h"

namespace pleat {

// Vertex k lies on the upper side along x, y and z where its first, second and third bit is set. A
// side goes round counterclockwise where its normal, the product of the two others, leads out.
BodySurface box_body(const Vec3& centre, const Vec3& size, const Vec3& x, const Vec3& y) {
  const Mat3 axes = (Mat3() << x, y, x.cross(y)).finished();
  BodySurface box;
  box.places.resize(3, 8);
  for (int k = 0; k < 8; ++k) {
    const Vec3 corner((k & 1) - 0.5, (k >> 1 & 1) - 0.5, (k >> 2 & 1) - 0.5);
    box.places.col(k) = centre + axes * size.cwiseProduct(corner);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int first = 1 << (axis + 1) % 3;
    const int second = 1 << (axis + 2) % 3;
    for (const bool is_upper : {false, true}) {
      const int low = is_upper ? 1 << axis : 0;
      const VertexId a(low), b(low + first), c(low + first + second), d(low + second);
      if (is_upper) {
        box.triangles.push_back({a, b, c});
        box.triangles.push_back({a, c, d});
      } else {
        box.triangles.push_back({a, c, b});
        box.triangles.push_back({a, d, c});
      }
    }
  }
  return box;
}

// Tetrahedra from one vertex to all faces, so that places far off cost no digits.
double enclosed_volume(const PositionsView& places, const std::vector<Triangle>& triangles) {
  if (triangles.empty()) return 0;
  const Vec3 origin = places.col(triangles[0][0]);
  double sum = 0;
  for (const Triangle& t : triangles) {
    const Vec3 a = places.col(t[0]) - origin;
    const Vec3 b = places.col(t[1]) - origin;
    const Vec3 c = places.col(t[2]) - origin;
    sum += a.dot(b.cross(c));
  }
  return sum / 6;
}

}  // namespace pleat
