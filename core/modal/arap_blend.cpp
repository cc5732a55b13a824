#include "core/modal/arap_blend.h"

#include <algorithm>
#include <cmath>

#include "core/base/rigid_motion.h"
#include "core/linalg/lbfgs.h"
#include "core/modal/nearest_rotation.h"

namespace pleat {
namespace {

/// Halves then differ by less than one in a hundred, from a tenth without.
constexpr double kEqualHalves = 20;
/// D of a stretch by 1e-7: less is the rounding of a rigid motion.
constexpr double kRigid = 1e-13;
/// The energy has so nearly ended to fall that x is known to a thousandth of its way: the square.
constexpr double kEnoughGain = 1e-6;

}  // namespace

double MiddleShape::unequal_halves() const {
  const double larger = std::max(distances.from_a, distances.from_b);
  return larger > 0 ? std::abs(distances.from_a - distances.from_b) / larger : 0;
}

MiddleShape middle_shape(const ArapBlend& blend, double scale) {
  MiddleShape middle;
  ShapeCoordinates gradient_a, gradient_b;
  DescentProblem problem;
  problem.value = [&](const ShapeCoordinates& x, ShapeCoordinates& gradient) {
    middle.distances = blend.distances(x, gradient_a, gradient_b);
    const auto [a, b] = middle.distances;
    const double sum = a + b;
    const double excess = sum > 0 ? (a - b) / sum : 0;
    const double shared = 1 - kEqualHalves * excess * excess;
    gradient = (shared + 2 * kEqualHalves * excess) * gradient_a +
               (shared - 2 * kEqualHalves * excess) * gradient_b;
    return sum * (1 + kEqualHalves * excess * excess);
  };
  problem.solve = [&](const ShapeCoordinates& gradient) { return blend.preconditioned(gradient); };
  problem.least_share = kEnoughGain;
  problem.least_gain = kRigid * scale;
  middle.shape = blend.half_turned();
  const DescentEnd end = descend(problem, middle.shape);
  middle.steps = end.steps;
  middle.converged = end.converged;
  middle.distances = blend.distances(middle.shape, gradient_a, gradient_b);
  if (middle.distances.from_a + middle.distances.from_b <= kRigid * scale)
    middle.distances = {0, 0};
  return middle;
}

Mat3 best_turn(const ShapeCoordinates& a, const ShapeCoordinates& b,
               const Eigen::VectorXd& weights) {
  return nearest_rotation(b * weights.asDiagonal() * a.transpose());
}

// Each turned by half towards the other, a and b fit best as they are; x is turned to fit their
// sum.
void turn_half_way(const ShapeCoordinates& a, const ShapeCoordinates& b,
                   const Eigen::VectorXd& weights, ShapeCoordinates& x) {
  const Mat3 half = half_turn(best_turn(a, b, weights));
  x = best_turn(x, half * a + half.transpose() * b, weights) * x;
}

Vec3 shift_half_way(const Positions& a, const Positions& b, const Positions& x) {
  constexpr double kStill = 1e-2;  // share of the extent; shorter moves all count alike
  const double still = kStill * std::max(box_diagonal(a), box_diagonal(b));
  const Eigen::VectorXd weights =
      ((a - b).colwise().squaredNorm().array() + still * still).inverse().matrix().transpose();
  return ((a + b) / 2 - x) * weights / weights.sum();
}

}  // namespace pleat
