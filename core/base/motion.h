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
    follow,     ///< goes and turns with `frame`
  };
  Kind kind = Kind::hold;
  Vec3 offset{0, 0, 0};                                ///< [m]
  double time_begin = 0;                               ///< [s]
  double time_end = 0;                                 ///< [s], at least time_begin
  double frequency = 0;                                ///< [Hz], for oscillate
  std::shared_ptr<const MovingFrame> frame = nullptr;  ///< set when the kind is `follow`

  /// Displacement since time 0 at a time [s]; only a frame turns.
  Pose pose(double time) const;
  /// Velocity [m/s] at a time [s] of a point that is at `place` [m] at time 0. At a jump it is that
  /// of the later part; a frame's is a central difference.
  Vec3 velocity(const Vec3& place, double time) const;
};

}  // namespace pleat
