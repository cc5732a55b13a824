#include "core/linalg/conjugate_gradient.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "core/base/check.h"
#include "core/linalg/block_matrix.h"
#include "core/linalg/finite_check.h"

namespace pleat {
namespace {

/// Above this tolerance the updated residual and b - A x agree to many digits; below it rounding
/// can part them.
constexpr double kTrustedTolerance = 1e-8;

/// A fresh residual must be at most this share of the one before, else rounding has the last word.
constexpr double kLeastProgress = 0.5;

/// Inverse of a packed symmetric block through its Cholesky factor. False unless every pivot is
/// positive.
bool invert_packed(const double* S, double* inverse, std::integral_constant<int, 1>) {
  inverse[0] = 1 / S[0];
  return S[0] > 0;
}

// With S = L L', the inverse is W'W for W = L^-1; packed order is 00 10 11 20 21 22.
bool invert_packed(const double* S, double* inverse, std::integral_constant<int, 3>) {
  if (!(S[0] > 0)) return false;
  const double l00 = std::sqrt(S[0]);
  const double l10 = S[1] / l00;
  const double l20 = S[3] / l00;
  const double pivot_1 = S[2] - l10 * l10;
  if (!(pivot_1 > 0)) return false;
  const double l11 = std::sqrt(pivot_1);
  const double l21 = (S[4] - l20 * l10) / l11;
  const double pivot_2 = S[5] - l20 * l20 - l21 * l21;
  if (!(pivot_2 > 0)) return false;
  const double l22 = std::sqrt(pivot_2);

  const double w00 = 1 / l00;
  const double w11 = 1 / l11;
  const double w22 = 1 / l22;
  const double w10 = -l10 * w00 * w11;
  const double w21 = -l21 * w11 * w22;
  const double w20 = -(l20 * w00 + l21 * w10) * w22;
  inverse[0] = w00 * w00 + w10 * w10 + w20 * w20;
  inverse[1] = w10 * w11 + w20 * w21;
  inverse[2] = w11 * w11 + w21 * w21;
  inverse[3] = w20 * w22;
  inverse[4] = w21 * w22;
  inverse[5] = w22 * w22;
  return true;
}

template <int N>
class ConjugateGradient final : public LinearSolver {
 public:
  explicit ConjugateGradient(const SolverOptions& options) : options_(options) {}

  void do_analyze(const SparseMatrix& lower) override {
    A_.analyze(lower);
    const auto n = static_cast<std::size_t>(lower.rows());
    inverses_.resize(static_cast<std::size_t>(A_.n_rows()) * kPackedSize<N>);
    residual_.resize(n);
    preconditioned_.resize(n);
    direction_.resize(n);
    image_.resize(n);
  }

  SolveReport do_factorize(const SparseMatrix& lower) override {
    A_.set_values(lower);
    for (int row = 0; row < A_.n_rows(); ++row) {
      double* inverse = inverses_.data() + row * kPackedSize<N>;
      if (!invert_packed(A_.diagonal_block(row), inverse, std::integral_constant<int, N>())) {
        return {SolveStatus::not_positive_definite, 0, 0,
                "diagonal block of row " + std::to_string(row * N) + " is not positive definite"};
      }
    }
    return {};
  }

  SolveReport do_solve(const Eigen::Ref<const Eigen::MatrixXd>& rhs,
                       Eigen::Ref<Eigen::MatrixXd> solution) override {
    if (auto report = report_not_finite(solution, "starting guess")) return *report;
    SolveReport total;
    for (Eigen::Index column = 0; column < rhs.cols(); ++column) {
      const SolveReport report = solve_column(rhs.col(column).data(), solution.col(column).data());
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
  double squared_norm(const double* values) const {
    double sum = 0;
    for (std::size_t k = 0; k < residual_.size(); ++k) sum += values[k] * values[k];
    return sum;
  }

  /// r = b - A x. Returns |r|^2.
  double start_residual(const double* b, const double* x) {
    A_.multiply(x, image_.data());
    for (std::size_t k = 0; k < residual_.size(); ++k) residual_[k] = b[k] - image_[k];
    return squared_norm(residual_.data());
  }

  /// x += alpha p, r -= alpha A p, z = preconditioned r, all in one pass. Returns |r|^2 and r'z.
  struct Norms {
    double residual;
    double preconditioned;
  };
  Norms advance(double alpha, double* x) {
    Norms norms{0, 0};
    for (int row = 0; row < A_.n_rows(); ++row) {
      const int begin = row * N;
      double* r = residual_.data() + begin;
      double* z = preconditioned_.data() + begin;
      for (int k = 0; k < N; ++k) {
        x[begin + k] += alpha * direction_[static_cast<std::size_t>(begin + k)];
        r[k] -= alpha * image_[static_cast<std::size_t>(begin + k)];
      }
      multiply_packed<N>(inverses_.data() + row * kPackedSize<N>, r, z);
      for (int k = 0; k < N; ++k) {
        norms.residual += r[k] * r[k];
        norms.preconditioned += r[k] * z[k];
      }
    }
    return norms;
  }

  SolveReport solve_column(const double* b, double* x) {
    const std::size_t n = residual_.size();
    const double b_squared = squared_norm(b);
    if (b_squared == 0) {
      std::fill(x, x + n, 0.0);
      return {};
    }
    const double goal = options_.tolerance * options_.tolerance * b_squared;
    const auto report = [&](SolveStatus status, int iterations, double r_squared,
                            const char* message) {
      return SolveReport{status, iterations, std::sqrt(r_squared / b_squared), message};
    };

    double r_squared = start_residual(b, x);
    double restart_squared = r_squared;
    std::fill(direction_.begin(), direction_.end(), 0.0);
    std::fill(image_.begin(), image_.end(), 0.0);
    double r_z = advance(0, x).preconditioned;
    double beta = 0;
    int iterations = 0;
    while (!(r_squared <= goal)) {
      if (iterations == options_.max_iterations) {
        return report(SolveStatus::not_converged, iterations, r_squared,
                      "the iteration cap was reached");
      }
      for (std::size_t k = 0; k < n; ++k) direction_[k] = preconditioned_[k] + beta * direction_[k];
      const double curvature = A_.multiply(direction_.data(), image_.data());
      if (!std::isfinite(curvature)) {
        return report(SolveStatus::not_finite, iterations, r_squared,
                      "a search direction is not finite");
      }
      if (curvature <= 0) {
        return report(SolveStatus::not_positive_definite, iterations, r_squared,
                      "a search direction has no positive curvature");
      }
      const Norms norms = advance(r_z / curvature, x);
      ++iterations;
      beta = norms.preconditioned / r_z;
      r_z = norms.preconditioned;
      r_squared = norms.residual;
      if (r_squared > goal || options_.tolerance >= kTrustedTolerance) continue;

      r_squared = start_residual(b, x);
      if (r_squared <= goal) break;
      if (r_squared > kLeastProgress * kLeastProgress * restart_squared) {
        return report(SolveStatus::not_converged, iterations, r_squared,
                      "rounding stops the residual");
      }
      restart_squared = r_squared;
      std::fill(image_.begin(), image_.end(), 0.0);
      r_z = advance(0, x).preconditioned;
      beta = 0;
    }
    return report(SolveStatus::ok, iterations, r_squared, "");
  }

  SolverOptions options_;
  BlockMatrix<N> A_;
  std::vector<double> inverses_;        // packed, one per diagonal block
  std::vector<double> residual_;        // r
  std::vector<double> preconditioned_;  // z
  std::vector<double> direction_;       // p
  std::vector<double> image_;           // A p
};

}  // namespace

std::unique_ptr<LinearSolver> make_conjugate_gradient(int block_size,
                                                      const SolverOptions& options) {
  PLEAT_CHECK(block_size == 1 || block_size == 3, "the block size must be 1 or 3");
  options.validate();
  if (block_size == 1) return std::make_unique<ConjugateGradient<1>>(options);
  return std::make_unique<ConjugateGradient<3>>(options);
}

}  // namespace pleat
