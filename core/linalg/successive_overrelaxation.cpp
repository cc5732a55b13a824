#include "core/linalg/successive_overrelaxation.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/linalg/block_matrix.h"
#include "core/linalg/finite_check.h"

namespace pleat {
namespace {

constexpr int kPowerIterations = 12;
constexpr double kLargestRadius = 0.9999;  // beyond, power iterations tell little

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

class SuccessiveOverrelaxation final : public LinearSolver {
 public:
  explicit SuccessiveOverrelaxation(const SolverOptions& options) : options_(options) {}

  void do_analyze(const SparseMatrix& lower) override {
    A_.analyze(lower);
    inverses_.resize(static_cast<std::size_t>(A_.n_rows()) * kPackedSize);
    for (std::vector<double>* vector : {&b_, &x_, &upper_, &next_upper_, &step_})
      vector->resize(static_cast<std::size_t>(lower.rows()));
    omega_ = options_.omega;
  }

  SolveReport do_factorize(const SparseMatrix& lower) override {
    A_.set_values(lower);
    for (int row = 0; row < A_.n_rows(); ++row)
      if (!invert_packed(A_.diagonal_block(row), inverses_.data() + row * kPackedSize))
        return {SolveStatus::not_positive_definite, 0, 0,
                "diagonal block of row " + std::to_string(A_.source(row)) +
                    " is not positive definite"};
    if (omega_ == 0) omega_ = best_omega();
    return {};
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
  /// Power iterations with G = I - D^-1 A, which is symmetric in the metric of D; how much they
  /// lengthen a vector there tends to the radius from below, whether G turns it round or not.
  double best_omega() {
    Random random(1);
    for (double& value : x_) value = random.uniform(-1, 1);
    double radius = 0;
    for (int iteration = 0; iteration <= kPowerIterations; ++iteration) {
      for (int row = 0; row < A_.n_rows(); ++row)
        multiply_packed(A_.diagonal_block(row), x_.data() + 3 * row, step_.data() + 3 * row);
      const double length = std::sqrt(dot(x_, step_));
      if (!(length > 0)) break;
      if (iteration > 0) radius = length;
      for (double& value : x_) value /= length;
      A_.multiply(x_.data(), step_.data());
      for (int row = 0; row < A_.n_rows(); ++row) {
        double move[3];
        multiply_packed(inverses_.data() + row * kPackedSize, step_.data() + 3 * row, move);
        for (int i = 0; i < 3; ++i) x_[static_cast<std::size_t>(3 * row + i)] -= move[i];
      }
    }
    radius = std::min(radius, kLargestRadius);
    return 2 / (1 + std::sqrt(1 - radius * radius));
  }

  /// upper_ = U x for the part U of A above the diagonal.
  void multiply_upper() {
    std::fill(upper_.begin(), upper_.end(), 0.0);
    for (int row = 0; row < A_.n_rows(); ++row)
      for (int k = A_.begin(row); k < A_.begin(row + 1); ++k)
        add_transposed(A_.block(k), x_.data() + 3 * row, upper_.data() + 3 * A_.column(k));
  }

  static void add_transposed(const double* block, const double* x, double* y) {
    for (int c = 0; c < 3; ++c) y[c] += block[c] * x[0] + block[3 + c] * x[1] + block[6 + c] * x[2];
  }

  /// One sweep. With the steps d that it makes, b - A x is (1/omega - 1) D d - U d afterwards, and
  /// U x is summed up on the way. Returns the norm of that.
  double sweep() {
    std::fill(next_upper_.begin(), next_upper_.end(), 0.0);
    for (int row = 0; row < A_.n_rows(); ++row) {
      double* x = x_.data() + 3 * row;
      double rest[3], own[3];
      multiply_packed(A_.diagonal_block(row), x, own);
      for (int i = 0; i < 3; ++i) rest[i] = b_[3 * row + i] - own[i] - upper_[3 * row + i];
      for (int k = A_.begin(row); k < A_.begin(row + 1); ++k) {
        const double* block = A_.block(k);
        const double* other = x_.data() + 3 * A_.column(k);
        for (int r = 0; r < 3; ++r)
          rest[r] -=
              block[3 * r] * other[0] + block[3 * r + 1] * other[1] + block[3 * r + 2] * other[2];
      }
      double* step = step_.data() + 3 * row;
      multiply_packed(inverses_.data() + row * kPackedSize, rest, step);
      for (int i = 0; i < 3; ++i) {
        step[i] *= omega_;
        x[i] += step[i];
        step[i] = (1 - omega_) * rest[i];  // (1/omega - 1) D d
      }
      for (int k = A_.begin(row); k < A_.begin(row + 1); ++k)
        add_transposed(A_.block(k), x, next_upper_.data() + 3 * A_.column(k));
    }
    double square = 0;
    for (std::size_t k = 0; k < step_.size(); ++k) {
      const double rest = step_[k] - (next_upper_[k] - upper_[k]);
      square += rest * rest;
    }
    std::swap(upper_, next_upper_);
    return std::sqrt(square);
  }

  double residual_of_x() {
    A_.multiply(x_.data(), step_.data());
    double square = 0;
    for (std::size_t k = 0; k < step_.size(); ++k)
      square += (b_[k] - step_[k]) * (b_[k] - step_[k]);
    return std::sqrt(square);
  }

  SolveReport solve_column() {
    const double b_norm = std::sqrt(dot(b_, b_));
    if (b_norm == 0) {
      std::fill(x_.begin(), x_.end(), 0.0);
      return {};
    }
    double residual = residual_of_x();
    if (!(residual <= b_norm)) {
      std::fill(x_.begin(), x_.end(), 0.0);
      residual = b_norm;
    }
    multiply_upper();
    const double goal = options_.tolerance * b_norm;
    SolveReport report;
    while (!(residual <= goal)) {
      if (report.iterations == options_.max_iterations) {
        report.status = SolveStatus::not_converged;
        report.message = "the iteration cap was reached";
        break;
      }
      residual = sweep();
      ++report.iterations;
      if (!std::isfinite(residual))
        return {SolveStatus::not_finite, report.iterations, 0, "a sweep is not finite"};
    }
    report.relative_residual = residual / b_norm;
    return report;
  }

  SolverOptions options_;
  BlockMatrix A_;
  std::vector<double> inverses_;  // of the diagonal blocks, packed
  double omega_ = 0;
  // Vectors in the order of the matrix's rows.
  std::vector<double> b_;
  std::vector<double> x_;
  std::vector<double> upper_;  // U x
  std::vector<double> next_upper_;
  std::vector<double> step_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_successive_overrelaxation(const SolverOptions& options) {
  options.validate();
  return std::make_unique<SuccessiveOverrelaxation>(options);
}

}  // namespace pleat
