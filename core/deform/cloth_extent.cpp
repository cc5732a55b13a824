#include "core/deform/cloth_extent.h"

#include <cmath>

#include "core/base/check.h"

namespace pleat {
namespace {

struct CornerPoints {
  Vec3 a, b, c;  // [m]

  double area() const { return (b - a).cross(c - a).norm() / 2; }
  Vec3 sum() const { return a + b + c; }
};

CornerPoints corner_points(const TriangleMesh& mesh, const Triangle& t, const Vec3& middle) {
  const Positions& x = mesh.rest_positions;
  return {x.col(t[0]) - middle, x.col(t[1]) - middle, x.col(t[2]) - middle};
}

/// A vertex as the origin keeps the digits of cloth that lies far off.
Vec3 middle_of(const TriangleMesh& mesh, double area) {
  const Vec3 origin = mesh.rest_positions.col(mesh.triangles[0][0]);
  Vec3 moment = Vec3::Zero();
  for (const Triangle& t : mesh.triangles) {
    const CornerPoints x = corner_points(mesh, t, origin);
    moment += x.area() / 3 * x.sum();
  }
  return origin + moment / area;
}

}  // namespace

/// Sums the integral of |x|^2, which is A/12 (|a|^2 + |b|^2 + |c|^2 + |a + b + c|^2) over a
/// triangle of area A.
double cloth_extent(const TriangleMesh& mesh) {
  PLEAT_CHECK(!mesh.triangles.empty(), "cloth has triangles");
  const double area = vertex_areas(mesh).sum();
  PLEAT_CHECK(area > 0, "cloth has an area");
  const Vec3 middle = middle_of(mesh, area);
  double integral = 0;
  for (const Triangle& t : mesh.triangles) {
    const CornerPoints x = corner_points(mesh, t, middle);
    integral += x.area() / 12 *
                (x.a.squaredNorm() + x.b.squaredNorm() + x.c.squaredNorm() + x.sum().squaredNorm());
  }
  return std::sqrt(12 * integral / area);
}

}  // namespace pleat
