#pragma once

#include "core/fabric/spring_lattice.h"

namespace pleat {

/// Where cloth gets stiffer in tension: its stiffness beyond the strain limit over that below.
/// Source: assets/SOURCES.md, stretch and shear.
constexpr double kTautFactor = 10;

/// Springs that add to the warp and weft springs among `springs` what makes them kTautFactor times
/// as stiff beyond `strain_limit` (positive): they pull from that strain on and never push.
std::vector<Spring> taut_springs(const std::vector<Spring>& springs, double strain_limit);

}  // namespace pleat
