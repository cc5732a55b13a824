#pragma once

#include <vector>

#include "core/modal/modes.h"
#include "core/model/cloth_model.h"

namespace pleat {

/// The lowest modes of a cloth about a shape, K phi = lambda M phi with the tangent stiffness K of
/// its springs, membrane and bending there; pins and what else is held stay where they are. Shapes
/// have zeros there. A negative lambda tells of a way that the shape falls rather than swings:
/// then it is not one of rest. Weight and air do not change with the shape and add nothing.
///
/// positions  one column per vertex [m]
/// held       vertices beside the model's pins, as those that lie on something
/// count      of modes; at most the free unknowns
///
/// Throws InputError where there are fewer, and for a cloth with hanging vertices.
SolveReport cloth_modes(const ClothModel& model, const Positions& positions,
                        const std::vector<VertexId>& held, int count, Modes& modes);

/// How much of a motion is in the first modes: for 1, 2, ... of them, the share of the moves'
/// squares, by mass and over all frames, that these modes span together; ascending, at most 1. All
/// 0 for a motion that stands still.
///
/// about  the shape that the modes are about [m]
Eigen::VectorXd motion_shares(const Modes& modes, const Eigen::VectorXd& masses,
                              const Positions& about, const std::vector<Positions>& frames);

}  // namespace pleat
