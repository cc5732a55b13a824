#pragma once

#include "core/modal/shape_space.h"

namespace pleat {

/// How far a shape x is from two others, a and b, all three of the same volume:
///
///     D(a -> x) = sum_c min_R sum_{t in c} V_t |F_t(x) - R F_t(a)|^2      [m^3]
///
/// tells how far x is from a turned copy of a, piece by piece: the pieces c, of one tetrahedron t
/// or more, have a rotation R each. V and F are those of the reference volume, alike for all pairs.
///
/// Source: Sorkine & Alexa, As-rigid-as-possible surface modeling, SGP 2007.
class ArapBlend {
 public:
  virtual ~ArapBlend() = default;

  struct Distances {
    double from_a, from_b;  ///< D(a -> x), D(b -> x)
  };

  /// Sets the gradients of both distances as well [m^2].
  virtual Distances distances(const ShapeCoordinates& x, ShapeCoordinates& gradient_a,
                              ShapeCoordinates& gradient_b) const = 0;
  /// Shape of least sum if every piece turned half way from a to b, about the origin. Pieces take
  /// the short way round each, so that a and b must not be turned against each other as a whole.
  virtual ShapeCoordinates half_turned() const = 0;
  /// Gradient through the inverse Hessian of D(a -> x) + D(b -> x) while no piece turns [m].
  virtual ShapeCoordinates preconditioned(const ShapeCoordinates& gradient) const = 0;
};

/// A shape half way between two others.
struct MiddleShape {
  ShapeCoordinates shape;  ///< its place and its turn as a whole are nobody's choice
  ArapBlend::Distances distances{0, 0};
  int steps = 0;          ///< steps of the descent
  bool converged = true;  ///< false where the cap on steps ended it

  /// |D(a -> x) - D(b -> x)| over the larger one; 0 where a and b are rigid motions of each other.
  double unequal_halves() const;
};

/// Minimises, by L-BFGS,
///
///     D(a -> x) + D(b -> x) + kEqualHalves (D(a -> x) - D(b -> x))^2 / (D(a -> x) + D(b -> x))
///
/// scale  three times the volume: D of what shrinks to nothing
MiddleShape middle_shape(const ArapBlend& blend, double scale);

/// The turn of a that fits b best, both about the origin. Columns count by their weights.
Mat3 best_turn(const ShapeCoordinates& a, const ShapeCoordinates& b,
               const Eigen::VectorXd& weights);

/// Turns x, about the origin, to where it is half way from a to b as a whole: best fits to both
/// have turned by half of the best fit of a to b. Columns count by their weights.
void turn_half_way(const ShapeCoordinates& a, const ShapeCoordinates& b,
                   const Eigen::VectorXd& weights, ShapeCoordinates& x);

/// The shift that brings points of x half way between those of a and b: the mean over all, those
/// counting most that move least from a to b. So what stays where it is in both stays, as the held
/// edge of a swinging cloth does; all moving alike, it is the shift of the centroid.
Vec3 shift_half_way(const Positions& a, const Positions& b, const Positions& x);

}  // namespace pleat
