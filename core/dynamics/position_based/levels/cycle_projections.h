#pragma once

#include "core/dynamics/position_based/projections.h"

namespace pleat {

/// Projections on any mesh: attachments to pins once, then in each round a cycle over coarse levels
/// and the constraints of the mesh itself, as far as the options ask for them. Cloth without
/// triangles has no coarse levels.
std::unique_ptr<Projections> cycle_projections(const ClothModel& model,
                                               const MethodOptions& options,
                                               const LaneLayout& layout, SpringLaw law, double h);

}  // namespace pleat
