#pragma once

#include "core/refinement/refinement_plan.h"

namespace pleat {

/// Splits the base of a uniform mesh, step by step where each vertex that is added saves most of
/// the sum of the losses. A step is a face, or a few side by side as long as each vertex then saves
/// more, with the splits that balance needs; what hangs because of it, or no longer does, counts.
/// Ties go to the first face.
///
/// fine     refined uniformly
/// losses   one column for each of its faces
/// options  of PlanCriterion::shape, with the level cap. It ends as soon as the mesh loses no more
///          than options.largest_loss, or when no face fits into options.max_vertices any more.
std::vector<PlannedSplit> shape_splits(const QuadMesh& fine, const FaceLosses& losses,
                                       const PlanOptions& options);

}  // namespace pleat
