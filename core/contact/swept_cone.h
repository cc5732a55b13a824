#pragma once

#include "core/contact/swept_contact.h"

namespace pleat {

/// Balls along a segment whose radius goes linearly from its start (share 0) to its end (share 1).
struct BallRow {
  Vec3 begin{0, 0, 0};      ///< [m]
  Vec3 direction{0, 1, 0};  ///< unit
  double length = 0;        ///< [m]
  double per_length = 0;    ///< 1 / length [1/m]; 0 without length
  double radius = 1;        ///< radius at the start [m]
  double growth = 0;        ///< growth of the radius, to the end [m]
  double sine = 0;          ///< sine of the angle between surface and axis: growth / length
  double cosine = 1;
  double tangent = 0;
  double first_share = 0;  ///< nearest balls lie between these shares; both are the larger end's
  double last_share = 1;   ///< when its ball holds all the others

  double radius_at(double share) const { return radius + share * growth; }
};

/// A rounded cone over one substep, grown by its clearance.
struct SweptCone {
  Vec3 origin{0, 0, 0};              ///< centre_a at the end of the substep [m]
  Mat3 to_local = Mat3::Identity();  ///< rows: normal of the trapezoid of centres, axis, across
  BallRow axis;                      ///< row of the cone, in local directions from the origin
  BallRow edge;  ///< row along the edge of the trapezoid where `across` is positive
  bool has_width = false;
  double half_width = 0;  ///< half width at centre_a [m]
  double widening = 0;    ///< growth of the half width, to centre_b [m]
  Vec3 shift{0, 0, 0};    ///< how far the solid moves during the substep [m]

  double half_width_at(double share) const { return half_width + share * widening; }
};

/// cone       where it is at the end of the substep
/// clearance  [m]
/// shift      how far it moves during the substep [m]
SweptCone swept(const RoundedCone& cone, const Clearance& clearance, const Vec3& shift);

/// Takes from the clearance.
void shrink(SweptCone& cone, const Clearance& inset);

/// Meeting of a path with a cone.
struct ConeMeeting {
  double height_begin = 0;  ///< height of the path's start above the surface [m]
  std::optional<Impact> impact;
};

/// The counterpart of first_impact for a sphere. The place where the surface is met is found to
/// 1e-12 of the larger radius, and never too late.
ConeMeeting meeting(const SweptCone& cone, const Vec3& begin, const Vec3& end, double slack);

inline std::optional<Impact> first_impact(const SweptCone& cone, const Vec3& begin, const Vec3& end,
                                          double slack) {
  return meeting(cone, begin, end, slack).impact;
}

Gap gap(const SweptCone& cone, const Vec3& place);

}  // namespace pleat
