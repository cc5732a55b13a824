#pragma once

#include <array>

#include "core/base/simd.h"
#include "core/base/vec.h"
#include "core/contact/swept_cone.h"

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
    Float4 begin, growth;  ///< [m]
    Float4 axis_tangent,
        edge_tangent;  ///< tangents of the angles between surface and rows of balls
  };

  LaneCone() = default;
  /// cone   the directions and lengths of it
  /// bare   radii at its ends without clearance [m]
  /// added  to what the faces' radii ask for [m]
  LaneCone(const SweptCone& cone, const std::array<double, 2>& bare, double added);

  /// True where neither end's ball holds all the others: other cones are not known here.
  static bool is_regular(const SweptCone& cone, const std::array<double, 2>& bare);

  /// face_squares  of the radii of the vertices' faces [m^2]
  Radii radii(Float4 face_squares) const;

  /// place  from the centre, at the start [m]
  Height above(const Vec3Lanes<Float4>& place, const Radii& radii) const;

 private:
  using Row = std::array<float, 3>;

  std::array<Row, 3> to_local_{};
  bool has_width_ = false;
  float axis_per_length_ = 0, edge_per_length_ = 0;  // [1/m]
  float length_ = 0;                                 // length of the axis [m]
  float half_width_ = 0, widening_ = 0;              // [m]
  float edge_y_ = 0, edge_z_ = 0;                    // direction of the edge
  float square_a_ = 0, square_b_ = 0;                // squared bare radii [m^2]
  float added_ = 0;                                  // [m]
};

}  // namespace pleat
