#pragma once

#include "core/base/vec.h"

namespace pleat {

/// The half space below it is solid.
struct Plane {
  Vec3 point{0, 0, 0};   ///< any point of it [m]
  Vec3 normal{0, 1, 0};  ///< unit, away from the solid
};

struct Sphere {
  Vec3 centre{0, 0, 0};  ///< [m]
  double radius = 1;     ///< [m], positive
};

}  // namespace pleat
