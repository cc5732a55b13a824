#include "core/dynamics/position_based/lanes/lane_cone.h"

#include <cmath>

namespace pleat {

LaneCone::LaneCone(const SweptCone& cone, const std::array<double, 2>& bare, double added)
    : has_width_(cone.has_width),
      axis_per_length_(static_cast<float>(cone.axis.per_length)),
      edge_per_length_(static_cast<float>(cone.edge.per_length)),
      length_(static_cast<float>(cone.axis.length)),
      half_width_(static_cast<float>(cone.half_width)),
      widening_(static_cast<float>(cone.widening)),
      edge_y_(static_cast<float>(cone.edge.direction.y())),
      edge_z_(static_cast<float>(cone.edge.direction.z())),
      square_a_(static_cast<float>(bare[0] * bare[0])),
      square_b_(static_cast<float>(bare[1] * bare[1])),
      added_(static_cast<float>(added)) {
  for (int k = 0; k < 9; ++k)
    to_local_[static_cast<std::size_t>(k / 3)][static_cast<std::size_t>(k % 3)] =
        static_cast<float>(cone.to_local(k / 3, k % 3));
}

// Faces' radii bring those of both ends nearer to each other.
bool LaneCone::is_regular(const SweptCone& cone, const std::array<double, 2>& bare) {
  constexpr double kLargestSine = 0.99;
  return std::abs(bare[1] - bare[0]) < kLargestSine * cone.axis.length;
}

// A clearance's part of faces makes sqrt(r^2 + c^2) of the radius r.
LaneCone::Radii LaneCone::radii(Float4 face_squares) const {
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
LaneCone::Height LaneCone::above(const Vec3Lanes<Float4>& place, const Radii& radii) const {
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
