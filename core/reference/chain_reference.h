#pragma once

#include <span>

#include "core/reference/reference.h"

namespace pleat {

/// Positions of a sheet that swings from its whole upper edge, taken for inextensible and limp: its
/// rows then move as the nodes of a planar chain of rigid links with the rows' masses, so that the
/// last one has half of an inner one.
///
/// times  [s], positive, ascending.
///
/// Converged when halving the integration's step moves no node by more than kChainTolerance. Throws
/// InputError for a scene that does not swing so: anything but a sheet released at rest, held by
/// its whole upper edge alone, weft horizontal, without air or solids.
Reference chain_reference(const Scene& scene, std::span<const double> times);

/// [m]: a thousandth of the distance by which real cloth differs from the chain.
constexpr double kChainTolerance = 1e-6;

}  // namespace pleat
