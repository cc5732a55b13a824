#pragma once

#include <memory>

#include "core/base/pose.h"

namespace pleat {

/// A prescribed motion of a pin or a collider, seen from its place at time 0.
struct Motion {
  enum class Kind {
    hold,       ///< stays where it is
    move,       ///< goes by `offset` between time_begin and time_end at constant speed
    ease,       ///< takes the path of `move`, from rest to rest (cubic smoothstep)
    oscillate,  ///< offset * sin(2 pi frequency (t - time_begin)) from time_begin on
    follow,     ///< goes and turns with `frame`
  };
  Kind kind = Kind::hold;
  Vec3 offset{0, 0, 0};                                ///< [m]
  double time_begin = 0;                               ///< [s]
  double time_end = 0;                                 ///< [s], at least time_begin
  double frequency = 0;                                ///< [Hz], for oscillate
  std::shared_ptr<const MovingFrame> frame = nullptr;  ///< what `follow` follows, then not null

  /// Its displacement at a time [s]; only a frame turns.
  Pose pose(double time) const;
  /// Velocity [m/s] at a time [s] of what is at `place` [m] at time 0. Where it jumps, that of the
  /// later part; of a frame by central differences.
  Vec3 velocity(const Vec3& place, double time) const;
};

}  // namespace pleat
