#pragma once

#include "core/base/vec.h"

namespace pleat {

struct State {
  Positions positions;   ///< [m]
  Positions velocities;  ///< [m/s], same size
};

}  // namespace pleat
