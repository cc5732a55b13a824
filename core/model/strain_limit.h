#pragma once

#include <vector>

#include "core/model/stretch.h"

namespace pleat {

/// How edges that are too long at the end of a substep are shortened.
enum class StrainLimitLaw {
  velocity,  ///< the velocities change with the places, and momentum is kept
  provot,    ///< the places change alone, as Provot published it in 1995: for comparison
};

struct StrainLimitOptions {
  StrainLimitLaw law = StrainLimitLaw::velocity;
  double stretch = 0.1;  ///< tau: an edge is at most (1 + tau) L long; positive
  double compression =
      1;  ///< an edge is at least (1 - this) L long; in (0, 1], 1: as short as can be
  int max_sweeps = 100;  ///< sweeps over all edges in a substep, at least 1

  /// Throws ContractError.
  void validate() const;
};

/// The edges of a cloth that have limits, whatever its elastic model. Edges that follow one another
/// and share a vertex, the first one's b and the next one's a, are corrected together.
struct StrainLimit {
  StrainLimitOptions options;
  std::vector<GaugeEdge> edges;
};

/// The edges in the order of lines: an edge is followed by that which at rest goes on most nearly
/// straight from its end, within 45 degrees, and is in no line yet.
std::vector<GaugeEdge> in_lines(const std::vector<GaugeEdge>& edges,
                                const PositionsView& rest_positions);

}  // namespace pleat
