#pragma once

#include "core/model/cloth_model.h"
#include "core/refinement/refinement_plan.h"
#include "native-tests/support/meshes.h"

namespace pleat {

/// 1 m x 1 m, 3 x 3 base faces, of which some are refined up to three times: hanging vertices also
/// beside one another.
QuadMesh graded_sheet(std::uint64_t seed);

/// Every third base face is split once.
RefinementPlan patchy_plan(const QuadMesh& base);

/// S: x = S y with three coordinates per vertex, y those of the vertices that do not hang.
Eigen::MatrixXd prolongation(const ClothModel& model);

}  // namespace pleat
