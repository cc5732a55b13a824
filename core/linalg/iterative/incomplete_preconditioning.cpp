#include "core/linalg/iterative/incomplete_preconditioning.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pleat {

void IncompletePreconditioning::analyze(const SparseMatrix& lower) {
  factor_.analyze(lower);
  for (std::vector<double>* vector : {&r_, &z_, &p_, &t_, &s_})
    vector->resize(static_cast<std::size_t>(lower.rows()));
}

double IncompletePreconditioning::start(const std::vector<double>& b,
                                        const std::vector<double>& x) {
  factor_.multiply(x.data(), r_.data());
  double squared = 0;
  for (std::size_t k = 0; k < r_.size(); ++k) {
    r_[k] = b[k] - r_[k];
    squared += r_[k] * r_[k];
  }
  residual_ = std::sqrt(squared);
  factor_.solve_lower(r_.data(), r_.data());
  std::fill(p_.begin(), p_.end(), 0.0);
  std::fill(s_.begin(), s_.end(), 0.0);
  r_z_ = factor_.multiply_pivots(r_.data(), z_.data());
  ratio_ = residual_ / std::sqrt(r_z_);
  beta_ = 0;
  return residual_;
}

double IncompletePreconditioning::next_direction() {
  for (std::size_t k = 0; k < p_.size(); ++k) p_[k] = z_[k] + beta_ * p_[k];
  return factor_.apply(p_.data(), t_.data(), s_.data());
}

void IncompletePreconditioning::advance(double curvature, std::vector<double>& x) {
  const double alpha = r_z_ / curvature;
  for (std::size_t k = 0; k < x.size(); ++k) {
    x[k] += alpha * t_[k];
    r_[k] -= alpha * (t_[k] + s_[k]);
    s_[k] = 0;
  }
  const double last_r_z = r_z_;
  r_z_ = factor_.multiply_pivots(r_.data(), z_.data());
  beta_ = r_z_ / last_r_z;
}

// |(P + L) r| takes half a product: it is looked at closely when |r|, in the metric of P, has
// fallen as far as it has to by the ratio that both had last.
double IncompletePreconditioning::residual(double goal, Look look) {
  residual_ = ratio_ * std::sqrt(r_z_);
  if (residual_ > goal && look == Look::passing) return residual_;
  residual_ = factor_.norm_of_lower_product(r_.data());
  ratio_ = residual_ / std::sqrt(r_z_);
  return residual_;
}

}  // namespace pleat
