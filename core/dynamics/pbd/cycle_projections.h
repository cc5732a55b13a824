#pragma once

#include "core/dynamics/xpbd/projections.h"

namespace pleat {

/// Projections on any mesh, in sets that share no vertex: attachments to pins, then coarse levels,
/// then the constraints of the mesh itself, as far as the options ask for them. A round is one such
/// cycle. Cloth without triangles has no coarse levels.
std::unique_ptr<Projections> cycle_projections(const ClothModel& model,
                                               const MethodOptions& options,
                                               const LaneLayout& layout, SpringLaw law, double h);

}  // namespace pleat
