#pragma once

#include "core/base/vec.h"

namespace pleat {

/// A sum of weighted squared distances to planes and points, as a function of a place x:
/// x.Ax + 2 b.x + c.
///
/// Source: Garland & Heckbert, Surface simplification using quadric error metrics, SIGGRAPH 1997.
struct Quadric {
  Mat3 A = Mat3::Zero();  ///< symmetric
  Vec3 b = Vec3::Zero();
  double c = 0;

  /// Squared distance [m^2] to the plane through `point` with the unit normal `normal`, times
  /// `weight`.
  static Quadric of_plane(const Vec3& point, const Vec3& normal, double weight) {
    const double offset = -normal.dot(point);
    return {weight * normal * normal.transpose(), weight * offset * normal,
            weight * offset * offset};
  }

  /// Squared distance to a point [m^2], times `weight`.
  static Quadric of_point(const Vec3& point, double weight) {
    return {weight * Mat3::Identity(), -weight * point, weight * point.squaredNorm()};
  }

  Quadric& operator+=(const Quadric& other) {
    A += other.A;
    b += other.b;
    c += other.c;
    return *this;
  }

  double at(const Vec3& x) const { return x.dot(A * x) + 2 * b.dot(x) + c; }
};

}  // namespace pleat
