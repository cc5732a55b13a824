#include "core/dynamics/position_based/converged_step.h"

#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/dynamics/position_based/spring_law.h"
#include "core/linalg/make_linear_solver.h"

namespace pleat {
namespace {

/// Relative residual that a linear solve leaves: what is left, the next iteration takes.
constexpr double kLinearResidual = 1e-9;

struct StepSpring {
  Eigen::Index a, b;
  double rest;        // [m]
  double compliance;  // compliance/h^2, relative to the inverse masses
};

/// The pull of a spring per multiplier, and how it changes with d, its vector at the end.
struct Pull {
  double length;
  Vec3 along;      // d(length)/dd
  Vec3 direction;  // l g / slope
  Mat3 change;     // d(direction)/dd
};

Pull pull_of(const Vec3& d, const Vec3& d_begin) {
  const Vec3 g = d + d_begin;
  const double square = d.squaredNorm();
  const double length = std::sqrt(square);
  const bool is_clamped = d.dot(g) < square;
  const double slope = is_clamped ? square : d.dot(g);
  const Vec3 slope_change = is_clamped ? Vec3(2 * d) : Vec3(g + d);
  const Vec3 along = d / length;
  const Vec3 direction = (length / slope) * g;
  const Mat3 change = (g * along.transpose() + length * Mat3::Identity()) / slope -
                      direction * slope_change.transpose() / slope;
  return {length, along, direction, change};
}

/// A factor of the symmetric matrix that is near the unsymmetric one, in the form that Eigen asks
/// for.
struct NearFactor {
  std::unique_ptr<LinearSolver> solver = make_linear_solver(best_direct_solver());
  bool is_analyzed = false;

  bool refresh(const SparseMatrix& lower) {
    if (!is_analyzed) solver->analyze(lower);
    is_analyzed = true;
    return solver->factorize(lower).ok();
  }
  NearFactor& compute(const Eigen::SparseMatrix<double, Eigen::RowMajor>& /*refreshed before*/) {
    return *this;
  }
  Eigen::VectorXd solve(const Eigen::VectorXd& rhs) const {
    Eigen::VectorXd solution = Eigen::VectorXd::Zero(rhs.size());
    solver->solve(rhs, solution);
    return solution;
  }
  Eigen::ComputationInfo info() const { return Eigen::Success; }
};

class StepEquations {
 public:
  StepEquations(const ClothModel& model, const PredictedStep& step)
      : model_(model), step_(step), unknowns_(3 * model.n_vertices()) {
    PLEAT_CHECK(model.hanging.empty(), "no vertex hangs");
    mean_mass_ = model.masses.mean();
    is_held_.resize(static_cast<std::size_t>(model.n_vertices()), false);
    for (const Pin& pin : model.pins) is_held_[pin.vertex] = true;
    const double h = step.h;
    for (const int s : active_springs(model)) {
      const Spring& spring = model.springs[static_cast<std::size_t>(s)];
      springs_.push_back({spring.a.value, spring.b.value, spring.rest_length,
                          mean_mass_ / (spring.stiffness * h * h)});
    }
    x_ = step.predicted;
    multipliers_.setZero(static_cast<Eigen::Index>(springs_.size()));
    evaluate();
  }

  double error() const { return right_side_.norm(); }
  const Positions& positions() const { return x_; }

  /// Solves for a change of all unknowns, without the multipliers first. False when that fails.
  bool find_change() {
    Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(unknowns_, unknowns_);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    SparseMatrix near(unknowns_, unknowns_);
    near.setFromTriplets(near_entries_.begin(), near_entries_.end());
    if (!iteration_.preconditioner().refresh(near)) return false;
    iteration_.setTolerance(kLinearResidual);
    change_.resize(right_side_.size());
    change_.head(unknowns_) = iteration_.compute(matrix).solve(reduced_right_side_);
    if (iteration_.info() == Eigen::NumericalIssue) return false;
    for (std::size_t s = 0; s < springs_.size(); ++s) {
      const Eigen::Index row = unknowns_ + static_cast<Eigen::Index>(s);
      const StepSpring& spring = springs_[s];
      const Vec3 apart = change_.segment<3>(3 * spring.a) - change_.segment<3>(3 * spring.b);
      change_[row] = (right_side_[row] - alongs_[s].dot(apart)) / spring.compliance;
    }
    return change_.allFinite();
  }

  /// Goes so far along the change.
  void go(double share) {
    flat(x_) += share * change_.head(unknowns_);
    multipliers_ += share * change_.tail(multipliers_.size());
    evaluate();
  }

  double largest_change() const {
    double most = 0;
    for (Eigen::Index i = 0; i < unknowns_; i += 3)
      most = std::max(most, change_.segment<3>(i).norm());
    return most;
  }

 private:
  bool is_held(Eigen::Index v) const { return is_held_[static_cast<std::size_t>(v)]; }

  /// The right side is minus the equations: (x - x_predicted)/w - G^T lambda, then C + compliance
  /// lambda. The matrix is of the places alone, each multiplier's equation put into theirs.
  void evaluate() {
    entries_.clear();
    near_entries_.clear();
    alongs_.clear();
    right_side_.setZero(unknowns_ + multipliers_.size());
    for (Eigen::Index v = 0; v < x_.cols(); ++v) {
      const double inertia = is_held(v) ? 1 : model_.masses[v] / mean_mass_;
      add_block(v, v, inertia * Mat3::Identity(), inertia * Mat3::Identity());
      right_side_.segment<3>(3 * v) = inertia * (step_.predicted.col(v) - x_.col(v));
    }
    for (const BendElement& bend : model_.bends) add_bend(bend);
    reduced_right_side_ = right_side_.head(unknowns_);
    for (std::size_t s = 0; s < springs_.size(); ++s) add_spring(springs_[s], s);
    for (Eigen::Index v = 0; v < x_.cols(); ++v) {
      if (!is_held(v)) continue;
      right_side_.segment<3>(3 * v).setZero();
      reduced_right_side_.segment<3>(3 * v).setZero();
    }
  }

  void add_spring(const StepSpring& spring, std::size_t number) {
    const Eigen::Index row = unknowns_ + static_cast<Eigen::Index>(number);
    const double multiplier = multipliers_[static_cast<Eigen::Index>(number)];
    const Pull pull = pull_of(x_.col(spring.a) - x_.col(spring.b),
                              step_.begins.col(spring.a) - step_.begins.col(spring.b));
    right_side_[row] = spring.rest - pull.length - spring.compliance * multiplier;
    alongs_.push_back(pull.along);
    const Mat3 along = pull.along * pull.along.transpose();
    const Mat3 block =
        pull.direction * pull.along.transpose() / spring.compliance - multiplier * pull.change;
    const Mat3 near = along / spring.compliance +
                      std::max(0.0, -multiplier) / (2 * pull.length) * (Mat3::Identity() - along);
    const std::array<Eigen::Index, 2> ends = {spring.a, spring.b};
    for (const Eigen::Index v : ends) {
      if (is_held(v)) continue;
      const double sign = v == spring.a ? 1 : -1;
      right_side_.segment<3>(3 * v) += sign * multiplier * pull.direction;
      reduced_right_side_.segment<3>(3 * v) +=
          sign * (multiplier + right_side_[row] / spring.compliance) * pull.direction;
      for (const Eigen::Index w : ends)
        if (!is_held(w)) add_block(v, w, (v == w ? 1 : -1) * block, (v == w ? 1 : -1) * near);
    }
  }

  /// A linear force: its multiplier is eliminated.
  void add_bend(const BendElement& bend) {
    if (bend.stiffness == 0) return;
    const double stiffness = bend.stiffness * step_.h * step_.h / mean_mass_;
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) sum += bend.weights[k] * x_.col(bend.vertices[k]);
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Index v = bend.vertices[i].value;
      if (is_held(v)) continue;
      right_side_.segment<3>(3 * v) -= stiffness * bend.weights[i] * sum;
      for (std::size_t j = 0; j < 3; ++j) {
        if (is_held(bend.vertices[j].value)) continue;
        const Mat3 block = stiffness * bend.weights[i] * bend.weights[j] * Mat3::Identity();
        add_block(v, bend.vertices[j].value, block, block);
      }
    }
  }

  /// `near` is symmetric over all, and positive definite.
  void add_block(Eigen::Index v, Eigen::Index w, const Mat3& block, const Mat3& near) {
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index j = 0; j < 3; ++j) {
        const auto row = static_cast<int>(3 * v + i);
        const auto column = static_cast<int>(3 * w + j);
        entries_.emplace_back(row, column, block(i, j));
        if (row >= column) near_entries_.emplace_back(row, column, near(i, j));
      }
  }

  const ClothModel& model_;
  const PredictedStep& step_;
  Eigen::Index unknowns_;  // coordinates
  double mean_mass_ = 0;   // [kg]
  std::vector<bool> is_held_;
  std::vector<StepSpring> springs_;
  Positions x_;
  Eigen::VectorXd multipliers_;
  std::vector<Eigen::Triplet<double>> entries_, near_entries_;
  std::vector<Vec3> alongs_;  // d(length)/dd of each spring
  Eigen::VectorXd right_side_, reduced_right_side_, change_;
  Eigen::BiCGSTAB<Eigen::SparseMatrix<double, Eigen::RowMajor>, NearFactor> iteration_;
};

}  // namespace

ConvergedStep converged_step(const ClothModel& model, const PredictedStep& step) {
  constexpr int kMostIterations = 60;
  constexpr int kMostHalvings = 12;
  constexpr double kRounding = 1e-11;  // share of the extent
  StepEquations equations(model, step);
  const double first = equations.error();
  const double extent = box_diagonal(step.begins);
  ConvergedStep result;
  while (!result.is_converged && result.iterations < kMostIterations && equations.find_change()) {
    ++result.iterations;
    result.last_change = equations.largest_change();
    result.is_converged = result.last_change < kRounding * extent;
    const double before = equations.error();
    double share = 1;
    equations.go(1);
    for (int i = 0; i < kMostHalvings && !result.is_converged && !(equations.error() < before);
         ++i) {
      equations.go(-share / 2);
      share /= 2;
    }
  }
  result.positions = equations.positions();
  result.relative_error = first > 0 ? equations.error() / first : 0;
  return result;
}

}  // namespace pleat
