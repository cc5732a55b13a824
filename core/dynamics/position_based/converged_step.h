#pragma once

#include "core/dynamics/position_based/step_solve.h"

namespace pleat {

/// Limit of a position-based solve of a step with rounds without end.
struct ConvergedStep {
  Positions positions;  ///< [m]
  double last_change =
      0;  ///< largest of any vertex in the last iteration [m]: how well they are known
  double relative_error = 0;  ///< residual of its equations, over that at the predicted places
  int iterations = 0;
  bool is_converged = false;  ///< the last change was rounding
};

/// Newton's method in double precision on the equations that projections sweep over,
///
///     x = x_predicted + W G(x)^T lambda,   C(x) + compliance/h^2 lambda = 0,
///
/// all unknowns at once: W inverse masses, G the directions that springs pull
/// along (core/dynamics/position_based/spring_law.h). Sweeps add pulls along directions of places
/// on their way, so that what they come to differs from this by as much as these turn within the
/// solve.
///
/// Springs are compliant, for rigid ones single out no solution: of a flat sheet of triangles they
/// are more than its places have numbers in its plane. Dampers brake what comes of it, and are no
/// part of it. Cloth with hanging vertices throws ContractError.
ConvergedStep converged_step(const ClothModel& model, const PredictedStep& step);

}  // namespace pleat
