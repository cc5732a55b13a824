#pragma once

#include <deque>
#include <functional>

#include "core/base/vec.h"

namespace pleat {

/// Changes of a descent's gradient in its last steps, beyond what its metric knows. Source: Nocedal
/// & Wright, Numerical optimization, Springer 2006, section 7.2.
class LbfgsCorrections {
 public:
  /// most  how many to keep, the latest; each costs four products of two columns
  explicit LbfgsCorrections(std::size_t most) : most_(most) {}

  bool empty() const { return corrections_.empty(); }
  void clear() { corrections_.clear(); }

  /// The gradient changed along with the positions. Nothing where it does not curve upward.
  void remember(Positions change, Positions gradient_change);

  /// -H g by the two-loop recursion; `solve` is the inverse of the metric times a gradient.
  Positions descent(const Positions& gradient,
                    const std::function<Positions(const Positions&)>& solve) const;

 private:
  struct Correction {
    Positions change, gradient_change;
    double product;  // inner product of the two
  };

  std::size_t most_;
  std::deque<Correction> corrections_;
};

/// A function of places to make small.
struct DescentProblem {
  /// Its value at x; sets the gradient.
  std::function<double(const Positions& x, Positions& gradient)> value;
  /// The inverse of a metric, positive definite, times a gradient.
  std::function<Positions(const Positions& gradient)> solve;
  /// Ends where a step promises to gain less than this share of the value, or than so much.
  double least_share = 0;
  double least_gain = 0;
  int most_steps = 200;
};

struct DescentEnd {
  int steps = 0;
  bool converged = true;  ///< false where the cap ended it, or no step gained
};

/// L-BFGS from x, steps halved until the value falls enough (Armijo).
DescentEnd descend(const DescentProblem& problem, Positions& x);

}  // namespace pleat
