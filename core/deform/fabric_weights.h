#pragma once

#include "core/fabric/deform_weights.h"
#include "core/fabric/fabric.h"

namespace pleat {

/// omega = v' / (v'_R + v'_S + v'_B): the weights that a fabric's normalised measures stand for.
/// They add up to one.
///
/// Throws ContractError unless the measures are finite, none is negative and one is positive.
/// Source: Liu, Wang & Luo, Realistic cloth simulation based on geometrical measurement and
/// deformation, Journal of Software 26(7), 2015, formula (8), printed without the parentheses.
DeformWeights recomputed_weights(const GeometricMeasures& normalised);

}  // namespace pleat
