#include "core/linalg/lbfgs.h"

#include <algorithm>
#include <vector>

namespace pleat {
namespace {

double inner_product(const Positions& a, const Positions& b) { return flat(a).dot(flat(b)); }

}  // namespace

void LbfgsCorrections::remember(Positions change, Positions gradient_change) {
  // A metric stays positive only by what curves upward.
  constexpr double kLeastCosine = 1e-10;
  const double product = inner_product(change, gradient_change);
  if (product <= kLeastCosine * change.norm() * gradient_change.norm()) return;
  corrections_.push_back({std::move(change), std::move(gradient_change), product});
  if (corrections_.size() > most_) corrections_.pop_front();
}

Positions LbfgsCorrections::descent(const Positions& gradient,
                                    const std::function<Positions(const Positions&)>& solve) const {
  Positions q = -gradient;
  std::vector<double> shares(corrections_.size());
  for (std::size_t k = corrections_.size(); k-- > 0;) {
    shares[k] = inner_product(corrections_[k].change, q) / corrections_[k].product;
    q -= shares[k] * corrections_[k].gradient_change;
  }
  Positions direction = solve(q);
  for (std::size_t k = 0; k < corrections_.size(); ++k) {
    const Correction& c = corrections_[k];
    direction += (shares[k] - inner_product(c.gradient_change, direction) / c.product) * c.change;
  }
  return direction;
}

DescentEnd descend(const DescentProblem& problem, Positions& x) {
  constexpr std::size_t kMostCorrections = 8;
  constexpr int kMostHalvings = 20;
  constexpr double kSufficientDecrease = 1e-4;
  DescentEnd end;
  LbfgsCorrections corrections(kMostCorrections);
  Positions gradient;
  double value = problem.value(x, gradient);
  for (;; ++end.steps) {
    const Positions direction = corrections.descent(gradient, problem.solve);
    const double slope = inner_product(gradient, direction);
    if (-slope <= std::max(problem.least_share * value, problem.least_gain)) return end;
    const Positions start = x;
    const Positions gradient_there = gradient;
    const double value_there = value;
    const auto has_gained = [&](double share) {
      x = start + share * direction;
      value = problem.value(x, gradient);
      return value <= value_there + kSufficientDecrease * share * slope;
    };
    double share = 1;
    int halvings = 0;
    while (halvings < kMostHalvings && !has_gained(share)) {
      share /= 2;
      ++halvings;
    }
    end.converged = end.steps < problem.most_steps && halvings < kMostHalvings;
    if (!end.converged) {
      x = start;
      return end;
    }
    corrections.remember(x - start, gradient - gradient_there);
  }
}

}  // namespace pleat
