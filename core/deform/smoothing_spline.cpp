#include "core/deform/smoothing_spline.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/check.h"

namespace pleat {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// As u is in [0, 1], what lies beyond either end gives the curve of lambda = 0 or infinity, unless
// points crowd within a thousandth of the range.
constexpr double kLowestDecade = -12;
constexpr double kHighestDecade = 4;
constexpr int kStepsPerDecade = 4;

/// Points by x, and what does not depend on lambda.
struct SplineProblem {
  std::vector<CurvePoint> points;
  std::vector<Eigen::Index> knots;  // knot of each point
  double width = 1;                 // width of the range of x
  Eigen::VectorXd x;                // x of the knots
  Eigen::VectorXd counts;           // number of points per knot: w
  Eigen::VectorXd means;            // mean y per knot
  Eigen::MatrixXd Q;                // Q^T f: jumps of slope at the inner knots of a polygon f(u)
  Eigen::MatrixXd R;                // Gram matrix of the hat functions of the inner knots
};

bool is_before(const CurvePoint& a, const CurvePoint& b) { return a.x < b.x; }

/// Knots, their counts and means.
void gather_knots(SplineProblem& problem) {
  const auto n_points = static_cast<Eigen::Index>(problem.points.size());
  problem.x.resize(n_points);
  problem.counts.setZero(n_points);
  problem.means.setZero(n_points);
  Eigen::Index n = 0;
  for (const CurvePoint& point : problem.points) {
    if (n == 0 || point.x > problem.x[n - 1]) problem.x[n++] = point.x;
    problem.knots.push_back(n - 1);
    problem.counts[n - 1] += 1;
    problem.means[n - 1] += point.y;
  }
  problem.x.conservativeResize(n);
  problem.counts.conservativeResize(n);
  problem.means = problem.means.head(n).eval().cwiseQuotient(problem.counts);
}

/// f'' is piecewise linear with values gamma at the inner knots and zero at both ends. The polygon
/// through the values f and the spline agree there, and f'' integrated against the hat functions
/// gives the polygon's jumps of slope: R gamma = Q^T f. The integral of f''^2 is gamma^T R gamma.
void set_up_bending(SplineProblem& problem) {
  const Eigen::Index n_inner = problem.x.size() - 2;
  problem.Q.setZero(n_inner + 2, n_inner);
  problem.R.setZero(n_inner, n_inner);
  for (Eigen::Index j = 0; j < n_inner; ++j) {
    const double before = (problem.x[j + 1] - problem.x[j]) / problem.width;
    const double after = (problem.x[j + 2] - problem.x[j + 1]) / problem.width;
    problem.Q.col(j).segment<3>(j) << 1 / before, -1 / before - 1 / after, 1 / after;
    problem.R(j, j) = (before + after) / 3;
    if (j + 1 < n_inner) problem.R(j, j + 1) = problem.R(j + 1, j) = after / 6;
  }
}

SplineProblem spline_problem(std::span<const CurvePoint> points) {
  SplineProblem problem;
  problem.points.assign(points.begin(), points.end());
  for (const CurvePoint& point : points)
    PLEAT_CHECK(std::isfinite(point.x) && std::isfinite(point.y), "points are finite");
  std::sort(problem.points.begin(), problem.points.end(), is_before);
  gather_knots(problem);
  PLEAT_CHECK(problem.x.size() >= 3, "three different x");
  problem.width = problem.x[problem.x.size() - 1] - problem.x[0];
  set_up_bending(problem);
  return problem;
}

std::vector<SmoothingSpline::Knot> spline_knots(const SplineProblem& problem,
                                                const Eigen::VectorXd& values) {
  std::vector<SmoothingSpline::Knot> knots;
  for (Eigen::Index k = 0; k < values.size(); ++k) knots.push_back({problem.x[k], values[k], 0});
  return knots;
}

SmoothingSpline mean_curve(const SplineProblem& problem) {
  SmoothingSpline curve;
  curve.shape = CurveShape::level;
  curve.smoothing = kInfinity;
  const auto n = static_cast<double>(problem.points.size());
  const double mean = problem.means.dot(problem.counts) / n;
  curve.knots = spline_knots(problem, Eigen::VectorXd::Constant(problem.x.size(), mean));
  double sum = 0;
  for (const CurvePoint& point : problem.points) sum += std::pow(point.y - mean, 2);
  curve.leave_one_out_error = std::sqrt(sum / n) * n / (n - 1);
  return curve;
}

/// Solves for f. With W = diag(w) and the means m, the sum of squares is (m - f)^T W (m - f) and
/// what does not depend on f, hence W (m - f) = lambda Q gamma with R gamma = Q^T f (Reinsch). With
/// t = lambda/(1 + lambda) and gamma = (1 - t) c,
///
///     ((1 - t) R + t Q^T W^-1 Q) c = Q^T m,     f = m - t W^-1 Q c,
///
/// which holds at lambda = infinity as well. So f = (I - t B) m with B = W^-1 Q (...)^-1 Q^T, and a
/// point at knot k has the leverage h = (1 - t B_kk)/w_k. Without it, f_k is off from its y by
/// (y - f_k)/(1 - h); of a knot's only point this is (B m)_k/B_kk, for lambda = 0 too.
SmoothingSpline fitted_spline(const SplineProblem& problem, double smoothing) {
  const double t = smoothing == kInfinity ? 1 : smoothing / (1 + smoothing);
  const Eigen::MatrixXd weighed_q = problem.counts.cwiseInverse().asDiagonal() * problem.Q;
  const Eigen::LDLT<Eigen::MatrixXd> factor((1 - t) * problem.R +
                                            t * problem.Q.transpose() * weighed_q);
  const Eigen::MatrixXd B = weighed_q * factor.solve(problem.Q.transpose());
  const Eigen::VectorXd pulls = B * problem.means;
  const Eigen::VectorXd values = problem.means - t * pulls;

  SmoothingSpline spline;
  spline.shape = t < 1 ? CurveShape::curved : CurveShape::straight;
  spline.smoothing = smoothing;
  spline.knots = spline_knots(problem, values);
  const Eigen::VectorXd gammas =
      (1 - t) / std::pow(problem.width, 2) * factor.solve(problem.Q.transpose() * problem.means);
  for (Eigen::Index j = 0; j < gammas.size(); ++j)
    spline.knots[static_cast<std::size_t>(j + 1)].second_derivative = gammas[j];

  double sum = 0;
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    const Eigen::Index k = problem.knots[i];
    const double w = problem.counts[k];
    const double error = w == 1 ? pulls[k] / B(k, k)
                                : (problem.points[i].y - values[k]) / (1 - (1 - t * B(k, k)) / w);
    sum += error * error;
  }
  spline.leave_one_out_error = std::sqrt(sum / static_cast<double>(problem.points.size()));
  return spline;
}

SmoothingSpline spline_at(const SplineProblem& problem, double decade) {
  return fitted_spline(problem, std::pow(10, decade));
}

/// Golden section for one minimum between two decades.
SmoothingSpline refined(const SplineProblem& problem, double low, double high) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr double kTolerance = 1e-5;  // [decades]: the error is flat at its least
  double left = high - kGolden * (high - low);
  double right = low + kGolden * (high - low);
  SmoothingSpline at_left = spline_at(problem, left);
  SmoothingSpline at_right = spline_at(problem, right);
  while (high - low > kTolerance) {
    if (at_left.leave_one_out_error < at_right.leave_one_out_error) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - kGolden * (high - low);
      at_left = spline_at(problem, left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + kGolden * (high - low);
      at_right = spline_at(problem, right);
    }
  }
  return at_left.leave_one_out_error < at_right.leave_one_out_error ? at_left : at_right;
}

/// The decade of the grid that is off by least.
double best_decade(const SplineProblem& problem) {
  double best = kLowestDecade;
  double least = kInfinity;
  for (int i = 0; i <= kStepsPerDecade * (kHighestDecade - kLowestDecade); ++i) {
    const double decade = kLowestDecade + static_cast<double>(i) / kStepsPerDecade;
    const double error = spline_at(problem, decade).leave_one_out_error;
    if (error < least) {
      least = error;
      best = decade;
    }
  }
  return best;
}

}  // namespace

/// Value of f. Between two knots a before and b after x, f is the chord and a cubic that has f'' as
/// it is and vanishes at both: -(x - a)(b - x)/6 ((1 + (x - a)/h) f''_b + (1 + (b - x)/h) f''_a).
double SmoothingSpline::value(double x) const {
  PLEAT_CHECK(!std::isnan(x), "a number");
  x = std::clamp(x, low(), high());
  const auto is_after = [](double place, const Knot& knot) { return place < knot.x; };
  const auto b = std::upper_bound(knots.begin() + 1, knots.end() - 1, x, is_after);
  const auto a = b - 1;
  const double before = (x - a->x) / (b->x - a->x);
  const double after = 1 - before;
  const double bow = (1 + before) * b->second_derivative + (1 + after) * a->second_derivative;
  return before * b->value + after * a->value - (x - a->x) * (b->x - x) / 6 * bow;
}

SmoothingSpline smoothing_spline(std::span<const CurvePoint> points, double smoothing) {
  PLEAT_CHECK(smoothing >= 0, "smoothing is not negative");
  return fitted_spline(spline_problem(points), smoothing);
}

SmoothingSpline best_smoothing_spline(std::span<const CurvePoint> points) {
  const SplineProblem problem = spline_problem(points);
  const double decade = best_decade(problem);
  constexpr double kStep = 1.0 / kStepsPerDecade;
  SmoothingSpline best = mean_curve(problem);
  for (SmoothingSpline& spline :
       std::array{fitted_spline(problem, kInfinity),
                  refined(problem, decade - kStep, decade + kStep), fitted_spline(problem, 0)})
    if (spline.leave_one_out_error < best.leave_one_out_error) best = spline;
  return best;
}

}  // namespace pleat
