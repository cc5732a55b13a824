#pragma once

#include <span>
#include <vector>

#include "core/model/cloth_model.h"

namespace pleat {

/// The largest stretch that held vertices ask for by their distances from each other. Goes over
/// all pairs only where pins have moved against each other since it last did.
class PinStretch {
 public:
  /// pins  as they hold the cloth now
  /// rest  places of the vertices at rest [m]; those of a vertex never change
  /// now   places of the vertices [m]
  /// Returns l/L - 1; 0 where no two pins are further apart than at rest, and without pairs.
  double largest(std::span<const Pin> pins, const Positions& rest, const Positions& now);

 private:
  bool moved_as_one(std::span<const Pin> pins, const Positions& now) const;

  std::vector<VertexId> vertices_;
  Positions places_;  // their places when it last went over all pairs [m]
  double largest_ = 0;
};

}  // namespace pleat
