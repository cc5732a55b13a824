#pragma once

#include "core/base/vec.h"

namespace pleat {

/// A prescribed translation: how far a pin or a collider is from its place at time 0.
struct Motion {
  enum class Kind {
    hold,       ///< stays where it is
    move,       ///< goes by `offset` between time_begin and time_end at constant speed
    ease,       ///< the same path, starting and ending at rest (cubic smoothstep)
    oscillate,  ///< offset * sin(2 pi frequency (t - time_begin)) from time_begin on
  };
  Kind kind = Kind::hold;
  Vec3 offset{0, 0, 0};   ///< [m]
  double time_begin = 0;  ///< [s]
  double time_end = 0;    ///< [s], at least time_begin
  double frequency = 0;   ///< [Hz], for oscillate

  /// Displacement at time [s], in [m].
  Vec3 displacement(double time) const;
  /// Its rate [m/s]; where it jumps, that of the later part.
  Vec3 velocity(double time) const;
};

}  // namespace pleat
