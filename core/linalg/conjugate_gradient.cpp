#include "core/linalg/conjugate_gradient.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/linalg/block_matrix.h"
#include "core/linalg/finite_check.h"
#include "core/linalg/incomplete_factor.h"

namespace pleat {
namespace {

/// Above this tolerance the updated residual and b - A x agree to many digits; below it rounding
/// can part them.
constexpr double kTrustedTolerance = 1e-8;

/// A fresh residual must be at most this share of the one before, else rounding has the last word.
constexpr double kLeastProgress = 0.5;

double norm(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum);
}

/// With the matrix A = L + D + L' and the pivots P of its incomplete factor, it iterates on
/// W p = r for W = (P + L)^-1 A (P + L')^-1, in the metric of P; x moves along t = (P + L')^-1 p,
/// and the residual of A x = b is (P + L) r.
class ConjugateGradient final : public LinearSolver {
 public:
  explicit ConjugateGradient(const SolverOptions& options) : options_(options) {}

  void do_analyze(const SparseMatrix& lower) override {
    A_.analyze(lower);
    factor_.analyze();
    for (std::vector<double>* vector : {&b_, &x_, &r_, &z_, &p_, &t_, &s_})
      vector->resize(static_cast<std::size_t>(lower.rows()));
  }

  SolveReport do_factorize(const SparseMatrix& lower) override {
    A_.set_values(lower);
    const int row = factor_.compute();
    if (row < 0) return {};
    return {
        SolveStatus::not_positive_definite, 0, 0,
        "diagonal block of row " + std::to_string(A_.source(row)) + " is not positive definite"};
  }

  SolveReport do_solve(const Eigen::Ref<const Eigen::MatrixXd>& rhs,
                       Eigen::Ref<Eigen::MatrixXd> solution) override {
    if (auto report = report_not_finite(solution, "starting guess")) return *report;
    SolveReport total;
    for (Eigen::Index column = 0; column < rhs.cols(); ++column) {
      A_.gather(rhs.col(column).data(), b_.data());
      A_.gather(solution.col(column).data(), x_.data());
      const SolveReport report = solve_column();
      A_.scatter(x_.data(), solution.col(column).data());
      total.iterations += report.iterations;
      total.relative_residual = std::max(total.relative_residual, report.relative_residual);
      if (!report.ok() && total.ok()) {
        total.status = report.status;
        total.message = report.message;
      }
    }
    return total;
  }

 private:
  /// r of b - A x, and no direction yet. Returns |b - A x|.
  double start() {
    A_.multiply(x_.data(), r_.data());
    for (std::size_t k = 0; k < r_.size(); ++k) r_[k] = b_[k] - r_[k];
    const double residual = norm(r_);
    factor_.solve_lower(r_.data(), r_.data());
    std::fill(p_.begin(), p_.end(), 0.0);
    return residual;
  }

  void turn(double beta) {
    for (std::size_t k = 0; k < p_.size(); ++k) p_[k] = z_[k] + beta * p_[k];
    std::fill(s_.begin(), s_.end(), 0.0);
  }

  void advance(double alpha) {
    for (std::size_t k = 0; k < x_.size(); ++k) {
      x_[k] += alpha * t_[k];
      r_[k] -= alpha * (t_[k] + s_[k]);
    }
  }

  SolveReport solve_column() {
    const double b_norm = norm(b_);
    if (b_norm == 0) {
      std::fill(x_.begin(), x_.end(), 0.0);
      return {};
    }
    const double goal = options_.tolerance * b_norm;
    double residual = start();
    const auto report = [&](SolveStatus status, int iterations, const char* message) {
      return SolveReport{status, iterations, residual / b_norm, message};
    };

    if (residual > b_norm) {
      std::fill(x_.begin(), x_.end(), 0.0);
      residual = start();
    }
    double start_residual = residual;
    double r_z = factor_.multiply_pivots(r_.data(), z_.data());
    // |(P + L) r| takes half a product: it is looked at when |r|, in the metric of P, has fallen
    // as far as it has to, and the ratio of both taken anew.
    double ratio = residual / std::sqrt(r_z);
    double beta = 0;
    int iterations = 0;
    while (!(residual <= goal)) {
      if (iterations == options_.max_iterations) {
        residual = factor_.norm_of_lower_product(r_.data());
        return report(SolveStatus::not_converged, iterations, "the iteration cap was reached");
      }
      turn(beta);
      const double curvature = factor_.apply(p_.data(), t_.data(), s_.data());
      if (!std::isfinite(curvature))
        return report(SolveStatus::not_finite, iterations, "a search direction is not finite");
      if (curvature <= 0) {
        return report(SolveStatus::not_positive_definite, iterations,
                      "a search direction has no positive curvature");
      }
      advance(r_z / curvature);
      ++iterations;
      const double last_r_z = r_z;
      r_z = factor_.multiply_pivots(r_.data(), z_.data());
      beta = r_z / last_r_z;
      residual = ratio * std::sqrt(r_z);
      if (residual > goal) continue;

      residual = factor_.norm_of_lower_product(r_.data());
      ratio = residual / std::sqrt(r_z);
      if (residual > goal || options_.tolerance >= kTrustedTolerance) continue;

      residual = start();
      if (residual <= goal) break;
      if (residual > kLeastProgress * start_residual)
        return report(SolveStatus::not_converged, iterations, "rounding stops the residual");
      start_residual = residual;
      r_z = factor_.multiply_pivots(r_.data(), z_.data());
      ratio = residual / std::sqrt(r_z);
      beta = 0;
    }
    return report(SolveStatus::ok, iterations, "");
  }

  SolverOptions options_;
  BlockMatrix A_;
  IncompleteFactor factor_{A_};
  // In the order of the rows of A_.
  std::vector<double> b_;
  std::vector<double> x_;
  std::vector<double> r_;
  std::vector<double> z_;  // P r
  std::vector<double> p_;
  std::vector<double> t_;
  std::vector<double> s_;  // W p - t
};

}  // namespace

std::unique_ptr<LinearSolver> make_conjugate_gradient(const SolverOptions& options) {
  options.validate();
  return std::make_unique<ConjugateGradient>(options);
}

}  // namespace pleat
