#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/base/vec.h"

namespace pleat {

/// Takes one value or more.
double root_mean_square(std::span<const double> values);

/// The middle value, of an even number the mean of the two middle ones; NaN of none.
double median(std::vector<double> values);

/// RMS distance of the same material points of one cloth in two states at the same time [m].
///
/// positions, reference  [m]; column i is the same material point in both. One may be the finer
/// mesh: vertex i of a mesh
///                       is vertex i of its refinements, so the first columns are compared.
/// areas                 rest area of each compared point: weights, in any unit, none negative.
///
/// NaN where all are zero. Throws ContractError unless `areas` has the smaller of both column
/// counts.
double position_error(const PositionsView& positions, const PositionsView& reference,
                      const VectorView& areas);

/// The distance [m] that material points of 95 % of the area are within, as of position_error. NaN
/// where all areas are zero.
double position_error_95(const PositionsView& positions, const PositionsView& reference,
                         const VectorView& areas);

/// The limit of positions on three meshes, each with edges half as long as the one before.
struct MeshLimit {
  Positions positions;              ///< [m], of the vertices of the coarsest mesh
  double rate = 0;                  ///< distances fall by two to this power at each halving
  std::array<double, 2> distances;  ///< distances from each mesh to the next [m]
};

/// Richardson's extrapolation at the observed rate log2(d1/d2) of the distances d1 and d2 between
/// successive meshes; areas weigh the coarsest one's vertices. NaN where distances do not fall.
MeshLimit observed_limit(const std::array<Positions, 3>& meshes, const VectorView& areas);

}  // namespace pleat
