#pragma once

#include "core/fabric/spring_lattice.h"

namespace pleat {

/// The bilinear stretch law: stiffness in tension beyond the stiffening strain over that below.
/// Source: assets/SOURCES.md, stretch and shear.
constexpr double kTautFactor = 10;

/// Springs that add to the warp and weft springs among `springs` what makes them kTautFactor times
/// as stiff beyond `stiffening_strain` (positive): they pull from that strain on and never push.
std::vector<Spring> taut_springs(const std::vector<Spring>& springs, double stiffening_strain);

}  // namespace pleat
