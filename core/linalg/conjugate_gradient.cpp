#include "core/linalg/conjugate_gradient.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/linalg/block_iteration.h"
#include "core/linalg/incomplete_factor.h"

namespace pleat {
namespace {

/// Above this tolerance the updated residual and b - A x agree to many digits; below it rounding
/// can part them.
constexpr double kTrustedTolerance = 1e-8;

/// A fresh residual must be at most this share of the one before, else rounding has the last word.
constexpr double kLeastProgress = 0.5;

/// Steps between looks at the residual.
constexpr int kLookEvery = 4;

/// It iterates on W = (P + L)^-1 A (P + L')^-1 of an incomplete factor, in the metric of P: x moves
/// along t = (P + L')^-1 p, and the residual of A x = b is (P + L) r.
class ConjugateGradient final : public BlockIteration {
 public:
  explicit ConjugateGradient(const SolverOptions& options) : BlockIteration(options) {}

  void do_analyze(const SparseMatrix& lower) override {
    factor_.analyze(lower);
    for (std::vector<double>* vector : {&r_, &z_, &p_, &t_, &s_})
      vector->resize(static_cast<std::size_t>(lower.rows()));
  }

  SolveReport do_factorize(const SparseMatrix& lower) override {
    const int row = factor_.compute(lower);
    if (row < 0) return {};
    return {SolveStatus::not_positive_definite, 0, 0,
            "diagonal block of row " + std::to_string(rows().source(row)) +
                " is not positive definite"};
  }

 private:
  const BlockMatrix& rows() const { return factor_.rows(); }
  const BlockMatrix* ordered() const override { return &rows(); }

  /// Starts from x, without a direction yet.
  void start() {
    factor_.multiply(x_.data(), r_.data());
    for (std::size_t k = 0; k < r_.size(); ++k) r_[k] = b_[k] - r_[k];
    residual_ = norm(r_);
    factor_.solve_lower(r_.data(), r_.data());
    std::fill(p_.begin(), p_.end(), 0.0);
    std::fill(s_.begin(), s_.end(), 0.0);
    r_z_ = factor_.multiply_pivots(r_.data(), z_.data());
    ratio_ = residual_ / std::sqrt(r_z_);
    beta_ = 0;
  }

  void turn() {
    for (std::size_t k = 0; k < p_.size(); ++k) p_[k] = z_[k] + beta_ * p_[k];
  }

  void advance(double alpha) {
    for (std::size_t k = 0; k < x_.size(); ++k) {
      x_[k] += alpha * t_[k];
      r_[k] -= alpha * (t_[k] + s_[k]);
      s_[k] = 0;
    }
    const double last_r_z = r_z_;
    r_z_ = factor_.multiply_pivots(r_.data(), z_.data());
    beta_ = r_z_ / last_r_z;
  }

  SolveReport solve_column(double b_norm) override {
    const double goal = options_.tolerance * b_norm;
    int iterations = 0;
    const auto report = [&](SolveStatus status, const char* message) {
      return SolveReport{status, iterations, residual_ / b_norm, message};
    };

    start();
    if (!(residual_ <= b_norm)) {
      std::fill(x_.begin(), x_.end(), 0.0);
      start();
    }
    double start_residual = residual_;
    while (!(residual_ <= goal)) {
      if (iterations == options_.max_iterations)
        return report(SolveStatus::not_converged, "the iteration cap was reached");
      turn();
      const double curvature = factor_.apply(p_.data(), t_.data(), s_.data());
      if (!std::isfinite(curvature))
        return report(SolveStatus::not_finite, "a search direction is not finite");
      if (curvature <= 0) {
        return report(SolveStatus::not_positive_definite,
                      "a search direction has no positive curvature");
      }
      advance(r_z_ / curvature);
      ++iterations;

      // |(P + L) r| takes half a product: it is looked at now and then, and when |r|, in the metric
      // of P, has fallen as far as it has to by the ratio that both had last.
      residual_ = ratio_ * std::sqrt(r_z_);
      const bool is_last = iterations == options_.max_iterations;
      if (residual_ > goal && iterations % kLookEvery != 0 && !is_last) continue;
      residual_ = factor_.norm_of_lower_product(r_.data());
      ratio_ = residual_ / std::sqrt(r_z_);
      if (residual_ > goal || options_.tolerance >= kTrustedTolerance) continue;

      start();
      if (residual_ > goal && residual_ > kLeastProgress * start_residual)
        return report(SolveStatus::not_converged, "rounding stops the residual");
      start_residual = residual_;
    }
    return report(SolveStatus::ok, "");
  }

  IncompleteFactor factor_;
  // Vectors in the order of rows().
  std::vector<double> r_;
  std::vector<double> z_;  // P r
  std::vector<double> p_;
  std::vector<double> t_;
  std::vector<double> s_;  // W p - t
  double residual_ = 0;    // |b - A x|, as far as it is known
  double r_z_ = 0;         // r'z
  double ratio_ = 0;       // of the residual to the root of r'z, when both were last known
  double beta_ = 0;
};

}  // namespace

std::unique_ptr<LinearSolver> make_conjugate_gradient(const SolverOptions& options) {
  options.validate();
  return std::make_unique<ConjugateGradient>(options);
}

}  // namespace pleat
