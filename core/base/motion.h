#pragma once

#include <memory>

#include "core/base/pose.h"

namespace pleat {

/// A prescribed motion of a pin or a collider, seen from its place at time 0.
struct Motion {
  enum class Kind {
    hold,       ///< stays where it is
    move,       ///< goes by `offset` between time_begin and time_end at constant speed
    ease,       ///< goes the way of `move`, starting and ending at rest (cubic smoothstep)
    oscillate,  ///< offset * sin(2 pi frequency (t - time_begin)) from time_begin on
    turn,       ///< turns at `rate` about a line, between time_begin and time_end
    follow,     ///< goes and turns with `frame`
  };
  Kind kind = Kind::hold;
  Vec3 offset{0, 0, 0};                                ///< [m]
  double time_begin = 0;                               ///< [s]
  double time_end = 0;                                 ///< [s], at least time_begin
  double frequency = 0;                                ///< [Hz], for oscillate
  std::shared_ptr<const MovingFrame> frame = nullptr;  ///< set when the kind is `follow`
  Vec3 centre{0, 0, 0};                                ///< a point of the line of `turn` [m]
  Vec3 axis{0, 1, 0};                                  ///< unit vector along that line
  double rate = 0;  ///< [rad/s], positive: counterclockwise seen against `axis`

  /// True when it does more than shift.
  bool turns() const { return kind == Kind::turn || kind == Kind::follow; }
  /// Displacement since time 0 at a time [s].
  Pose pose(double time) const;
  /// Velocity [m/s] at a time [s] of a point that is at `place` [m] at time 0. At a jump it is that
  /// of the later part; a frame's is a central difference.
  Vec3 velocity(const Vec3& place, double time) const;
};

}  // namespace pleat
