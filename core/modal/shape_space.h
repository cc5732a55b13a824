#pragma once

#include <vector>

#include "core/modal/modes.h"
#include "core/modal/tet_mesh.h"

namespace pleat {

/// A shape in a space of k functions: how much of each, for x, y and z, one column per function.
using ShapeCoordinates = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// Shapes of a volume of n vertices: positions = coordinates * functions. With every shape, the
/// space has all its affine images, so that a shape may turn as far as it likes.
struct ShapeSpace {
  /// k x n, orthonormal in the masses: the constant, three that make it affine with that, then by
  /// falling weight.
  Eigen::MatrixXd functions;
  Eigen::VectorXd weights;  ///< singular value of each function; 0 for the first four
  Eigen::VectorXd masses;   ///< mass of each vertex

  int size() const { return static_cast<int>(functions.rows()); }
  Positions positions(const ShapeCoordinates& coordinates) const { return coordinates * functions; }
  /// Coordinates of the space's shape that is nearest in the masses.
  ShapeCoordinates coordinates(const Positions& positions) const {
    return positions * masses.asDiagonal() * functions.transpose();
  }
  Vec3 centroid(const ShapeCoordinates& coordinates) const {
    return coordinates.col(0) * functions(0, 0);
  }
};

inline constexpr int kAffineFunctions = 4;

/// Every mode gives a function for x, y and z, as large as one unit of energy makes it. Together
/// with the affine functions of the rest positions, and all coordinates of the `exact` shapes, they
/// span the space; functions are left out that weigh least.
///
/// masses       one per vertex, positive
/// modes        of one or more rest shapes with the same vertices
/// most         functions to keep, those of affine motions included
/// tolerance    functions that weigh less than this share of the heaviest are left out as well
///
/// Throws ContractError where no volume is spanned, or sizes disagree.
ShapeSpace shape_space(const Positions& rest, const Eigen::VectorXd& masses,
                       const std::vector<Modes>& modes, const std::vector<Positions>& exact,
                       int most, double tolerance = 1e-4);

}  // namespace pleat
