#pragma once

#include <vector>

#include "core/scene/scene.h"

namespace pleat {

struct RestartOptions {
  double begin = 1;     ///< first restart, and from one to the next [s], longer than `after`
  double after = 0.25;  ///< how long each runs [s], a whole number of steps
  double duration = 5;  ///< duration of the fine run, in which each restart ends [s]

  /// Throws InputError naming the value that is out of range.
  void validate() const;
};

/// Errors of a mesh before chance adds its own: again and again it starts from the state of a fine
/// run, sampled on it, and is held against the fine run, started anew alike, sampled on it a while
/// later.
///
/// fine    of a garment or sheet
/// others  of the same cloth, with the same step; the distance counts by rest area
///
/// For each of the others the root mean square distance after each restart [m], infinite when it
/// ended before; when the fine run does, no more follow. Throws InputError for options out of
/// range, other cloth or steps, and when a method cannot run.
std::vector<std::vector<double>> restart_errors(const Scene& fine, const std::vector<Scene>& others,
                                                const RestartOptions& options);

}  // namespace pleat
