#pragma once

#include <array>

#include "core/base/vec.h"
#include "core/contact/swept_cone.h"
#include "core/dynamics/xpbd/simd4.h"

namespace pleat {

/// A rounded cone as four places in single precision see it, each held off as its own faces ask.
///
/// The formulas are those of SweptCone, where the nearest ball is found, and its centre and radius,
/// for all places alike. Source: docs/methods/contact.md, "In lanes".
class LaneCone {
 public:
  /// Places above the surface.
  struct Height {
    Float4 height;             ///< [m], negative inside
    Vec3Lanes<Float4> normal;  ///< unit, away from the solid; not a number on the balls' centres
  };
  /// The grown radii, and what follows from them.
  struct Radii {
    Float4 begin, growth;               ///< [m]
    Float4 axis_tangent, edge_tangent;  ///< of the angles between surface and rows of balls
  };

  LaneCone() = default;
  /// cone   the directions and lengths of it
  /// bare   radii at its ends without clearance [m]
  /// added  to what the faces' radii ask for [m]
  LaneCone(const SweptCone& cone, const std::array<double, 2>& bare, double added);

  /// Whether neither end's ball holds all the others: those alone are known here.
  static bool is_regular(const SweptCone& cone, const std::array<double, 2>& bare);

  /// face_squares  of the radii of the vertices' faces [m^2]
  Radii radii(Float4 face_squares) const;

  /// place  from the centre at the begin [m]
  Height above(const Vec3Lanes<Float4>& place, const Radii& radii) const;

 private:
  using Row = std::array<float, 3>;

  std::array<Row, 3> to_local_{};
  bool has_width_ = false;
  float axis_per_length_ = 0, edge_per_length_ = 0;  // [1/m]
  float length_ = 0;                                 // of the axis [m]
  float half_width_ = 0, widening_ = 0;              // [m]
  float edge_y_ = 0, edge_z_ = 0;                    // direction of the edge
  float square_a_ = 0, square_b_ = 0;                // of the bare radii [m^2]
  float added_ = 0;                                  // [m]
};

// A contact's time goes in here: inline.

// A clearance's part of faces makes sqrt(r^2 + c^2) of the radius r.
inline LaneCone::Radii LaneCone::radii(Float4 face_squares) const {
  const auto tangent = [](Float4 sine) { return sine / sqrt(Float4::all(1) - sine * sine); };
  const Float4 at_a = sqrt(Float4::all(square_a_) + face_squares);
  const Float4 growth = sqrt(Float4::all(square_b_) + face_squares) - at_a;
  const Float4 axis_tangent = tangent(growth * Float4::all(axis_per_length_));
  return {at_a + Float4::all(added_), growth, axis_tangent,
          has_width_ ? tangent(growth * Float4::all(edge_per_length_)) : axis_tangent};
}

// Folded to the side of the edge, the place is (x, y, z) in local directions. Of the row along the
// edge, at `along` and `off` it, the nearest ball is at along + off tan; where that of the row
// along the axis, in the plane of x and y, is met before the edge, the ball beside it at z is.
inline LaneCone::Height LaneCone::above(const Vec3Lanes<Float4>& place, const Radii& radii) const {
  const Float4 zero = Float4::all(0);
  const Float4 one = Float4::all(1);
  const auto local = [&](const Row& row) {
    return Float4::all(row[0]) * place.x + Float4::all(row[1]) * place.y +
           Float4::all(row[2]) * place.z;
  };
  const auto share_at = [&](Float4 along, float per_length) {
    return min(max(Float4::all(per_length) * along, zero), one);
  };
  const Float4 x = local(to_local_[0]);
  const Float4 y = local(to_local_[1]);
  const Float4 z = local(to_local_[2]);
  const Float4 side = max(z, zero - z);
  const Float4 beyond = side - Float4::all(half_width_);
  const Float4 along = Float4::all(edge_y_) * y + Float4::all(edge_z_) * beyond;
  const Float4 aside = Float4::all(edge_y_) * beyond - Float4::all(edge_z_) * y;
  const Float4 off = sqrt(x * x + aside * aside);
  Float4 share = share_at(along + off * radii.edge_tangent, edge_per_length_);
  Float4 ahead = beyond - share * Float4::all(widening_);
  if (has_width_) {
    const Float4 above_axis = max(x, zero - x);
    const Float4 other = share_at(y + above_axis * radii.axis_tangent, axis_per_length_);
    const Float4 inside = other * Float4::all(widening_) - beyond;
    share = share + where_positive(inside, other - share);
    ahead = ahead - where_positive(inside, ahead);
  }
  const Float4 up = y - share * Float4::all(length_);
  const Float4 distance = sqrt(x * x + up * up + ahead * ahead);
  const Float4 inverse = one / distance;
  const Float4 normal_z = inverse * (ahead - where_positive(zero - z, ahead + ahead));
  const Float4 normal_x = inverse * x;
  const Float4 normal_y = inverse * up;
  const auto world = [&](std::size_t k) {
    return Float4::all(to_local_[0][k]) * normal_x + Float4::all(to_local_[1][k]) * normal_y +
           Float4::all(to_local_[2][k]) * normal_z;
  };
  return {distance - radii.begin - share * radii.growth, {world(0), world(1), world(2)}};
}

}  // namespace pleat
