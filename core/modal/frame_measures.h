#pragma once

#include "core/modal/key_completion.h"

namespace pleat {

/// Measures of a frame, of all its bodies together.
struct FrameMeasures {
  double volume = 0;          ///< [m^3]
  double strain = 0;          ///< root of the mean square of |F - R| since the first key
  int n_inverted = 0;         ///< tetrahedra turned inside out
  double unequal_halves = 0;  ///< |D(a -> x) - D(b -> x)| over the larger one
};

/// Measures of frames that a completion made.
std::vector<FrameMeasures> frame_measures(const KeyCompletion& completion,
                                          const std::vector<KeyCompletion::Frame>& frames);

/// Measures of frames at the same times whose vertices go straight from key to key, as the space
/// has these.
std::vector<FrameMeasures> linear_measures(const KeyCompletion& completion,
                                           const std::vector<KeyCompletion::Frame>& frames);

}  // namespace pleat
