#include "core/linalg/iterative/multigrid_preconditioning.h"

#include <cmath>
#include <cstddef>

namespace pleat {
namespace {

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

}  // namespace

void MultigridPreconditioning::analyze(const BlockMatrix& rows) {
  A_ = rows;
  multigrid_.analyze(A_);
  for (std::vector<double>* vector : {&r_, &z_, &p_, &image_})
    vector->assign(static_cast<std::size_t>(3 * A_.n_rows()), 0.0);
}

void MultigridPreconditioning::compute(const IncompleteFactor& factor,
                                       const std::vector<double>& places) {
  factor.copy_matrix(A_);
  if (!places.empty()) multigrid_.set_places(A_, places.data());
  multigrid_.compute(A_);
}

double MultigridPreconditioning::start(const std::vector<double>& b, const std::vector<double>& x) {
  A_.multiply(x.data(), r_.data());
  for (std::size_t k = 0; k < r_.size(); ++k) r_[k] = b[k] - r_[k];
  residual_ = std::sqrt(dot(r_, r_));
  r_z_ = 0;
  return residual_;
}

// z - z_last is judged by r - r_last = -alpha A p.
double MultigridPreconditioning::next_direction() {
  multigrid_.apply(r_.data(), residual_, z_.data());
  const double last_r_z = r_z_;
  const double beta = last_r_z > 0 ? -alpha_ * dot(z_, image_) / last_r_z : 0;
  r_z_ = dot(r_, z_);
  if (!(r_z_ > 0)) return r_z_;
  for (std::size_t k = 0; k < p_.size(); ++k) p_[k] = z_[k] + beta * p_[k];
  A_.multiply(p_.data(), image_.data());
  return dot(p_, image_);
}

void MultigridPreconditioning::advance(double curvature, std::vector<double>& x) {
  alpha_ = r_z_ / curvature;
  double squared = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    x[k] += alpha_ * p_[k];
    r_[k] -= alpha_ * image_[k];
    squared += r_[k] * r_[k];
  }
  residual_ = std::sqrt(squared);
}

double MultigridPreconditioning::residual(double /*goal*/, Look /*look*/) { return residual_; }

}  // namespace pleat
