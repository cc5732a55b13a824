#pragma once

#include "core/modal/key_completion.h"

namespace pleat {

/// What one frame of a completed motion is, beside the one that goes straight from key to key.
struct FrameCurves {
  double volume, straight_volume;  ///< [m^3]
  double strain, straight_strain;  ///< root of the mean square of |F - R| over the volume
};

/// Volumes and strains of all bodies together, as the first key is at rest.
std::vector<FrameCurves> completion_curves(const KeyCompletion& completion,
                                           const std::vector<KeyCompletion::Frame>& frames);

}  // namespace pleat
