#include "core/linalg/iterative/conjugate_gradient.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/linalg/iterative/block_iteration.h"
#include "core/linalg/iterative/incomplete_factor.h"
#include "core/linalg/iterative/multigrid_preconditioning.h"

namespace pleat {
namespace {

/// Tolerance above which the updated residual and b - A x agree to many digits; below it rounding
/// can part them.
constexpr double kTrustedTolerance = 1e-8;

/// A fresh residual must be at most this share of the one before, else rounding has the last word.
constexpr double kLeastProgress = 0.5;

/// Steps between close looks at the residual.
constexpr int kLookEvery = 4;

/// Steps with an incomplete factor after which multigrid takes over. Its levels take as long as 40
/// of them, a step of it as long as 4.
constexpr int kPatience = 60;

/// The most factorisations in a row that begin with multigrid once it had to take over: then the
/// incomplete factor is tried again, at a twentieth of what they took. 0, 1, 3, 7 and 15 times in a
/// row, from anew when the factor was fast enough.
constexpr int kMultigridTurns = 15;

/// An incomplete factor at no cost beside A's: it iterates on W = (P + L)^-1 A (P + L')^-1 in the
/// metric of P. x moves along t = (P + L')^-1 p, and the residual of A x = b is (P + L) r.
class IncompletePreconditioning final : public Preconditioning {
 public:
  void analyze(const SparseMatrix& lower) {
    factor_.analyze(lower);
    for (std::vector<double>* vector : {&r_, &z_, &p_, &t_, &s_})
      vector->resize(static_cast<std::size_t>(lower.rows()));
  }

  /// See IncompleteFactor::compute.
  int compute(const SparseMatrix& lower) { return factor_.compute(lower); }
  const IncompleteFactor& factor() const { return factor_; }

  double start(const std::vector<double>& b, const std::vector<double>& x) override {
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

  double next_direction() override {
    for (std::size_t k = 0; k < p_.size(); ++k) p_[k] = z_[k] + beta_ * p_[k];
    return factor_.apply(p_.data(), t_.data(), s_.data());
  }

  void advance(double curvature, std::vector<double>& x) override {
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
  double residual(double goal, Look look) override {
    residual_ = ratio_ * std::sqrt(r_z_);
    if (residual_ > goal && look == Look::passing) return residual_;
    residual_ = factor_.norm_of_lower_product(r_.data());
    ratio_ = residual_ / std::sqrt(r_z_);
    return residual_;
  }

 private:
  IncompleteFactor factor_;
  std::vector<double> r_;
  std::vector<double> z_;  // P r
  std::vector<double> p_;
  std::vector<double> t_;
  std::vector<double> s_;  // W p - t
  double residual_ = 0;    // |b - A x|, as far as it is known
  double r_z_ = 0;         // r'z
  double ratio_ = 0;       // ratio of the residual to the root of r'z, when both were last known
  double beta_ = 0;
};

class ConjugateGradient final : public BlockIteration {
 public:
  explicit ConjugateGradient(const SolverOptions& options) : BlockIteration(options) {}

  void set_places(const VectorView& places) override {
    places_.assign(places.data(), places.data() + places.size());
  }

  void do_analyze(const SparseMatrix& lower) override {
    multigrid_.reset();
    turns_left_ = next_turns_ = 0;
    is_multigrid_lost_ = false;
    incomplete_.analyze(lower);
  }

  SolveReport do_factorize(const SparseMatrix& lower) override {
    if (places_.size() != static_cast<std::size_t>(lower.rows())) places_.clear();
    active_ = &incomplete_;
    const int row = incomplete_.compute(lower);
    if (row >= 0)
      return {SolveStatus::not_positive_definite, 0, 0,
              "diagonal block of row " + std::to_string(ordered()->source(row)) +
                  " is not positive definite"};
    if (turns_left_ > 0)
      --turns_left_;
    else if (options_.preconditioner != Preconditioner::multigrid || is_multigrid_lost_)
      return {};
    take_multigrid();
    return {};
  }

 private:
  const BlockMatrix* ordered() const override { return &incomplete_.factor().rows(); }

  void start() { residual_ = active_->start(b_, x_); }

  bool loses_patience(int iterations) const {
    return options_.preconditioner == Preconditioner::automatic && active_ == &incomplete_ &&
           !is_multigrid_lost_ && iterations >= kPatience;
  }

  void take_multigrid() {
    if (!multigrid_) {
      multigrid_ = std::make_unique<MultigridPreconditioning>();
      multigrid_->analyze(incomplete_.factor().rows());
    }
    multigrid_->compute(incomplete_.factor(), places_);
    active_ = multigrid_.get();
  }

  /// Goes on with the incomplete factor where single precision loses a matrix.
  void lose_multigrid() {
    is_multigrid_lost_ = true;
    turns_left_ = 0;
    active_ = &incomplete_;
    start();
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
      if (loses_patience(iterations)) {
        take_multigrid();
        turns_left_ = next_turns_;
        next_turns_ = std::min(2 * next_turns_ + 1, kMultigridTurns);
        start();
        continue;
      }
      const double curvature = active_->next_direction();
      if (!std::isfinite(curvature))
        return report(SolveStatus::not_finite, "a search direction is not finite");
      if (curvature <= 0 && active_ != &incomplete_) {
        lose_multigrid();
        continue;
      }
      if (curvature <= 0) {
        return report(SolveStatus::not_positive_definite,
                      "a search direction has no positive curvature");
      }
      active_->advance(curvature, x_);
      ++iterations;

      const bool looks = iterations % kLookEvery == 0 || iterations == options_.max_iterations;
      residual_ = active_->residual(
          goal, looks ? Preconditioning::Look::close : Preconditioning::Look::passing);
      if (residual_ > goal || options_.tolerance >= kTrustedTolerance) continue;

      start();
      if (residual_ > goal && residual_ > kLeastProgress * start_residual)
        return report(SolveStatus::not_converged, "rounding stops the residual");
      start_residual = residual_;
    }
    if (active_ == &incomplete_) next_turns_ = 0;
    return report(SolveStatus::ok, "");
  }

  IncompletePreconditioning incomplete_;
  std::unique_ptr<MultigridPreconditioning> multigrid_;  // made once it is needed
  Preconditioning* active_ = nullptr;  // chosen by the last factorisation, or taken over since
  std::vector<double> places_;
  bool is_multigrid_lost_ = false;  // true once it was not positive definite in single precision
  int turns_left_ = 0;              // factorisations that are to start with multigrid
  int next_turns_ = 0;              // their number when it has to take over again
  double residual_ = 0;
};

}  // namespace

std::unique_ptr<LinearSolver> make_conjugate_gradient(const SolverOptions& options) {
  options.validate();
  return std::make_unique<ConjugateGradient>(options);
}

}  // namespace pleat
