#pragma once

#include <span>
#include <vector>

#include "core/contact/body_surface.h"
#include "core/contact/contact_pass.h"
#include "core/contact/signed_distance.h"

namespace pleat {

/// Tells how deep places are in bodies.
class BodyDepth {
 public:
  explicit BodyDepth(std::span<const BodySurface> bodies);

  /// Depth of vertices below the surfaces of the bodies as these are at a time [s].
  Penetration at(const PositionsView& positions, double time);

 private:
  struct Body {
    SignedDistance distance;
    Eigen::AlignedBox3d box;  // [m], at time 0
    Motion motion;
  };

  std::vector<Body> bodies_;
};

}  // namespace pleat
