#pragma once

#include <span>

#include "core/base/vec.h"

namespace pleat {

/// Of one value or more.
double root_mean_square(std::span<const double> values);

/// RMS distance of the same material points of one cloth in two states at the same time [m].
///
/// positions, reference  [m]; column i is the same material point in both. One may be the finer
/// mesh: vertex i of a mesh
///                       is vertex i of its refinements, so the first columns are compared.
/// areas                 rest area of each compared point, all positive: weights, in any unit.
///
/// Throws ContractError unless `areas` has the smaller of both column counts.
double position_error(const Eigen::Ref<const Positions>& positions,
                      const Eigen::Ref<const Positions>& reference,
                      const Eigen::Ref<const Eigen::VectorXd>& areas);

}  // namespace pleat
