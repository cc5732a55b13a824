#pragma once

#include <vector>

namespace pleat {

/// A matrix A with an approximate inverse, as conjugate gradients go along them. Vectors have the
/// order of the matrix's rows.
class Preconditioning {
 public:
  virtual ~Preconditioning() = default;

  /// Starts at x, without a direction yet. Returns |b - A x|.
  virtual double start(const std::vector<double>& b, const std::vector<double>& x) = 0;

  /// Finds the next search direction p. Returns p'A p, with the sign of the approximate inverse
  /// where that is not positive.
  virtual double next_direction() = 0;

  /// Moves x along the direction as far as is best; `curvature` is what `next_direction` returned.
  virtual void advance(double curvature, std::vector<double>& x) = 0;

  enum class Look {
    close,    ///< exact
    passing,  ///< exact where it might be at most `goal`, else about so large
  };
  /// |b - A x|, updated from step to step.
  virtual double residual(double goal, Look look) = 0;
};

}  // namespace pleat
