#include "core/modal/modes.h"

#include <Spectra/SymEigsShiftSolver.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/base/check.h"
#include "core/linalg/make_linear_solver.h"
#include "core/linalg/orthonormal.h"

namespace pleat {
namespace {

/// Shift as a share of the stiffest row over its mass, below the stiffness of all that resists: the
/// factor then is positive definite, and loses half of its sixteen digits. Where something resists
/// less than nothing, ten times as much is tried, and so on.
constexpr double kShift = 1e-8;
constexpr double kShiftGrowth = 10;
constexpr int kShiftHalvings = 4;
/// Relative, of the eigenvalues that the iteration tells.
constexpr double kTolerance = 1e-12;
constexpr int kMostRestarts = 300;

Eigen::VectorXd row_sums(const SparseMatrix& lower) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(lower.rows());
  for (int column = 0; column < lower.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry) {
      sums[entry.row()] += std::abs(entry.value());
      if (entry.row() != column) sums[column] += std::abs(entry.value());
    }
  return sums;
}

/// y = P M^1/2 (K - sigma M)^-1 M^1/2 P x, with P the projection to what is perpendicular to
/// M^1/2 times the null space. Its eigenvectors are M^1/2 phi, its largest eigenvalues
/// 1/(lambda - sigma) of the softest modes.
class ShiftInverse {
 public:
  using Scalar = double;

  ShiftInverse(LinearSolver& solver, const Eigen::VectorXd& root_masses,
               const Eigen::MatrixXd& null_space)
      : solver_(solver), root_masses_(root_masses), null_space_(null_space) {}

  Eigen::Index rows() const { return root_masses_.size(); }
  Eigen::Index cols() const { return root_masses_.size(); }
  void set_shift(double) {}  // the factor has it already

  void perform_op(const double* x_in, double* y_out) const {
    const Eigen::Map<const Eigen::VectorXd> x(x_in, rows());
    Eigen::Map<Eigen::VectorXd> y(y_out, rows());
    rhs_ = x;
    project(rhs_);
    rhs_.array() *= root_masses_.array();
    solution_.setZero(rows());
    const SolveReport report = solver_.solve(rhs_, solution_);
    if (report.ends_run()) report_ = report;
    solution_.array() *= root_masses_.array();
    project(solution_);
    y = solution_;
  }

  const SolveReport& report() const { return report_; }

 private:
  void project(Eigen::VectorXd& x) const {
    if (null_space_.cols() > 0) x -= null_space_ * (null_space_.transpose() * x);
  }

  LinearSolver& solver_;
  const Eigen::VectorXd& root_masses_;
  const Eigen::MatrixXd& null_space_;  // orthonormal columns
  mutable Eigen::VectorXd rhs_, solution_;
  mutable SolveReport report_;
};

Eigen::MatrixXd joined(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd columns(b.rows(), a.cols() + b.cols());
  columns << a, b;
  return columns;
}

/// Modes in the coordinates of ShiftInverse, softest first.
struct Pairs {
  Eigen::VectorXd values;   // lambda
  Eigen::MatrixXd vectors;  // orthonormal
  Eigen::Index n_operations = 0;
  SolveReport report;

  Eigen::Index size() const { return values.size(); }

  void append(double value, const Eigen::VectorXd& vector) {
    values.conservativeResize(size() + 1);
    values[size() - 1] = value;
    vectors = joined(vectors, vector);
  }

  /// Keeps the softest of both, as many as before. False when none of `others` is softer than the
  /// stiffest here.
  bool take_softer(const Pairs& others) {
    constexpr double kRounding = 1e-9;  // rounding of equal modes
    const double stiffest = values[size() - 1];
    if (others.size() == 0 || others.values[0] >= stiffest - kRounding * std::abs(stiffest))
      return false;
    Eigen::VectorXd all_values(size() + others.size());
    all_values << values, others.values;
    const Eigen::MatrixXd all_vectors = joined(vectors, others.vectors);
    std::vector<Eigen::Index> order(static_cast<std::size_t>(all_values.size()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](Eigen::Index a, Eigen::Index b) { return all_values[a] < all_values[b]; });
    order.resize(static_cast<std::size_t>(size()));
    values = all_values(order);
    vectors = all_vectors(Eigen::all, order);
    return true;
  }
};

/// Unit vector perpendicular to orthonormal columns, one fewer than their rows.
Eigen::VectorXd last_direction(const Eigen::MatrixXd& columns) {
  Eigen::Index least = 0;
  columns.rowwise().squaredNorm().minCoeff(&least);
  Eigen::VectorXd direction = Eigen::VectorXd::Unit(columns.rows(), least);
  for (int pass = 0; pass < 2; ++pass) direction -= columns * (columns.transpose() * direction);
  return direction.normalized();
}

/// Finds modes by shift and invert.
struct Softest {
  LinearSolver& solver;
  const Eigen::VectorXd& root_masses;
  double shift;

  /// So many, or those of them that converged, perpendicular to the orthonormal columns `known`.
  Pairs operator()(const Eigen::MatrixXd& known, Eigen::Index count) const {
    ShiftInverse inverse(solver, root_masses, known);
    // A Krylov space of twice the wanted size, as ARPACK's guide has it, but never more than there
    // is.
    const Eigen::Index n = root_masses.size();
    const Eigen::Index space = std::min<Eigen::Index>(n, std::max<Eigen::Index>(2 * count + 1, 20));
    Spectra::SymEigsShiftSolver<ShiftInverse> eigen(inverse, count, space, shift);
    eigen.init();
    eigen.compute(Spectra::SortRule::LargestMagn, kMostRestarts, kTolerance,
                  Spectra::SortRule::SmallestAlge);
    return {eigen.eigenvalues(), eigen.eigenvectors(), eigen.num_operations(), inverse.report()};
  }
};

SparseMatrix shifted(const SparseMatrix& stiffness, const Eigen::VectorXd& masses, double shift) {
  std::vector<Eigen::Triplet<double, int>> diagonal;
  diagonal.reserve(static_cast<std::size_t>(masses.size()));
  for (int i = 0; i < masses.size(); ++i) diagonal.emplace_back(i, i, shift * masses[i]);
  SparseMatrix sum(stiffness.rows(), stiffness.cols());
  sum.setFromTriplets(diagonal.begin(), diagonal.end());
  sum += stiffness;
  sum.makeCompressed();
  return sum;
}

void set_residuals(const SparseMatrix& stiffness, const Eigen::VectorXd& masses, double norm,
                   Modes& modes) {
  modes.residuals.resize(modes.size());
  for (Eigen::Index m = 0; m < modes.size(); ++m) {
    const Eigen::VectorXd phi = modes.shapes.col(m);
    const Eigen::VectorXd pull = stiffness.selfadjointView<Eigen::Lower>() * phi;
    const double rest = (pull - modes.stiffness[m] * masses.cwiseProduct(phi)).norm();
    modes.residuals[m] = norm > 0 ? rest / (norm * phi.norm()) : 0;
  }
}

}  // namespace

bool is_costless(const Modes& modes, Eigen::Index mode) {
  constexpr double kLeast = 1e-7;
  return std::abs(modes.stiffness[mode]) <= kLeast * modes.stiffness.cwiseAbs().maxCoeff();
}

SolveReport lowest_modes(const SparseMatrix& stiffness, const Eigen::VectorXd& masses,
                         const Eigen::MatrixXd& null_space, int count, Modes& modes) {
  const Eigen::Index n = stiffness.rows();
  const Eigen::Index n_null = null_space.cols();
  PLEAT_CHECK(stiffness.cols() == n && masses.size() == n &&
                  null_space.rows() == (n_null ? n : null_space.rows()),
              "stiffness, masses and null space are of the same unknowns");
  PLEAT_CHECK(masses.size() > 0 && masses.minCoeff() > 0, "every unknown has mass");
  PLEAT_CHECK(count > 0 && count <= n - n_null, "no more modes than there are");

  const Eigen::VectorXd root_masses = masses.cwiseSqrt();
  const Eigen::VectorXd sums = row_sums(stiffness);
  const double largest = sums.cwiseQuotient(masses).maxCoeff();
  double shift = kShift * largest;
  auto solver = make_linear_solver(SolverKind::supernodal);
  SparseMatrix lower = shifted(stiffness, masses, shift);
  solver->analyze(lower);
  SolveReport factored = solver->factorize(lower);
  const auto factorize_with = [&](double next) {
    shift = next;
    lower = shifted(stiffness, masses, shift);
    factored = solver->factorize(lower);
    return !factored.ends_run();
  };
  if (factored.ends_run()) {
    double too_little = shift;
    while (shift < largest && !factorize_with(kShiftGrowth * shift)) too_little = shift;
    if (factored.ends_run()) return factored;
    // The nearer to the lowest, the faster the iteration tells it from the next.
    double enough = shift;
    for (int k = 0; k < kShiftHalvings; ++k) {
      const double between = std::sqrt(too_little * enough);
      (factorize_with(between) ? enough : too_little) = between;
    }
    if (!factorize_with(enough)) return factored;
  }

  const Eigen::MatrixXd rigid = orthonormal_in_order(root_masses.asDiagonal() * null_space);
  const Eigen::Index wanted = std::min<Eigen::Index>(count, n - 1);  // no iteration finds all n
  const Softest softest{*solver, root_masses, -shift};
  Pairs pairs;
  pairs.vectors.resize(n, 0);
  if (wanted > 0) pairs = softest(rigid, wanted);
  if (pairs.report.ends_run()) return pairs.report;
  const bool all_converged = pairs.size() == wanted;
  // The Krylov space of one vector has, but for rounding, one of each modes of equal stiffness. The
  // others are perpendicular to it.
  while (n_null + pairs.size() < n && pairs.size() > 0) {
    const Pairs missed = softest(joined(rigid, pairs.vectors), 1);
    if (missed.report.ends_run()) return missed.report;
    pairs.n_operations += missed.n_operations;
    if (!pairs.take_softer(missed)) break;
  }

  if (all_converged && count > wanted) {
    const Eigen::VectorXd last = last_direction(joined(rigid, pairs.vectors));
    const Eigen::VectorXd shape = last.cwiseQuotient(root_masses);
    pairs.append(shape.dot(stiffness.selfadjointView<Eigen::Lower>() * shape), last);
  }

  modes.n_rigid = static_cast<int>(n_null);
  modes.stiffness = Eigen::VectorXd::Zero(n_null + pairs.size());
  modes.stiffness.tail(pairs.size()) = pairs.values;
  modes.shapes = root_masses.cwiseInverse().asDiagonal() * joined(rigid, pairs.vectors);
  set_residuals(stiffness, masses, sums.maxCoeff(), modes);

  SolveReport report;
  report.iterations = static_cast<int>(pairs.n_operations);
  report.relative_residual = modes.residuals.size() ? modes.residuals.maxCoeff() : 0;
  if (!all_converged) {
    report.status = SolveStatus::not_converged;
    report.message = "fewer modes converged than were asked for";
  }
  return report;
}

Eigen::MatrixXd rigid_motions(const Positions& positions, const std::vector<int>& part_of_vertex) {
  PLEAT_CHECK(static_cast<Eigen::Index>(part_of_vertex.size()) == positions.cols(),
              "every vertex is of a part");
  const int n_parts = part_of_vertex.empty()
                          ? 0
                          : *std::max_element(part_of_vertex.begin(), part_of_vertex.end()) + 1;
  Positions centres = Positions::Zero(3, n_parts);
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(n_parts);
  for (Eigen::Index v = 0; v < positions.cols(); ++v) {
    const int part = part_of_vertex[static_cast<std::size_t>(v)];
    centres.col(part) += positions.col(v);
    ++counts[part];
  }
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(3 * positions.cols(), 6 * n_parts);
  for (Eigen::Index v = 0; v < positions.cols(); ++v) {
    const int part = part_of_vertex[static_cast<std::size_t>(v)];
    const Vec3 arm = positions.col(v) - centres.col(part) / counts[part];
    motions.block<3, 3>(3 * v, 6 * part) = Mat3::Identity();
    for (int axis = 0; axis < 3; ++axis)
      motions.block<3, 1>(3 * v, 6 * part + 3 + axis) = Vec3::Unit(axis).cross(arm);
  }
  return motions;
}

}  // namespace pleat
