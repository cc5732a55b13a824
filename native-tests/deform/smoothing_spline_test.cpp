#include "core/deform/smoothing_spline.h"

#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/base/check.h"
#include "core/base/random.h"

namespace pleat {
namespace {

using Points = std::vector<CurvePoint>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// Points in no order; the last two share the x of the first.
Points scattered_points(std::uint64_t seed) {
  Random random(seed);
  Points points;
  for (int i = 0; i < 12; ++i) points.push_back({random.uniform(-2, 5), random.uniform(0, 1)});
  points.push_back({points[0].x, 0.1});
  points.push_back({points[0].x, 0.7});
  return points;
}

Points waves(int n) {
  Points points;
  for (int i = 0; i < n; ++i) points.push_back({0.1 * i, std::sin(0.6 * i)});
  return points;
}

/// `line` with +bump and -bump in turn.
template <class Line>
Points rough(const Line& line, double bump) {
  Points points;
  for (int i = 0; i < 15; ++i) points.push_back({0.1 * i, line(0.1 * i) + (i % 2 ? bump : -bump)});
  return points;
}

double mean_of_squares(const Points& points, const SmoothingSpline& curve) {
  double sum = 0;
  for (const CurvePoint& point : points) sum += std::pow(point.y - curve.value(point.x), 2);
  return sum / static_cast<double>(points.size());
}

/// Computes the same minimiser on its own: f = a + b x + sum theta_j |x - x_j|^3/12 with sum theta
/// = sum theta x = 0 has the integral of f''^2 sum theta_i theta_j |x_i - x_j|^3/12. One term per
/// point; of points that share an x, only the first has one. `smoothing` is per x as it is. In long
/// double, as kernels of near points are nearly alike.
class CubicKernels {
  using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  using RowVector = Eigen::Matrix<long double, 1, Eigen::Dynamic>;

 public:
  CubicKernels(const Points& points, double smoothing) {
    for (const CurvePoint& point : points)
      if (std::none_of(centres_.begin(), centres_.end(), [&](double x) { return x == point.x; }))
        centres_.push_back(point.x);
    const auto n = static_cast<Eigen::Index>(centres_.size());
    Matrix rows(points.size(), n + 2);
    Vector y(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      rows.row(static_cast<Eigen::Index>(i)) = basis(points[i].x);
      y[static_cast<Eigen::Index>(i)] = points[i].y;
    }
    Matrix system = Matrix::Zero(n + 4, n + 4);
    system.topLeftCorner(n + 2, n + 2) = rows.transpose() * rows;
    for (Eigen::Index j = 0; j < n; ++j) {
      const double x = centres_[static_cast<std::size_t>(j)];
      system.block(2, 2 + j, n, 1) +=
          static_cast<long double>(smoothing) * basis(x).tail(n).transpose();
      system.block<2, 1>(n + 2, 2 + j) << 1, x;
      system.block<1, 2>(2 + j, n + 2) << 1, x;
    }
    Vector right = Vector::Zero(n + 4);
    right.head(n + 2) = rows.transpose() * y;
    coefficients_ = system.fullPivLu().solve(right).head(n + 2);
  }

  double value(double x) const { return static_cast<double>(basis(x).dot(coefficients_)); }

 private:
  RowVector basis(double x) const {
    RowVector terms(centres_.size() + 2);
    terms.head<2>() << 1, x;
    for (std::size_t j = 0; j < centres_.size(); ++j)
      terms[static_cast<Eigen::Index>(j) + 2] =
          std::pow(std::abs(x - static_cast<long double>(centres_[j])), 3) / 12;
    return terms;
  }

  std::vector<double> centres_;
  Vector coefficients_;
};

double per_x(const SmoothingSpline& spline) {
  return spline.smoothing * std::pow(spline.high() - spline.low(), 3);
}

double brute_force_error(const Points& points, double smoothing_per_x) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Points others = points;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    sum += std::pow(points[i].y - CubicKernels(others, smoothing_per_x).value(points[i].x), 2);
  }
  return std::sqrt(sum / static_cast<double>(points.size()));
}

}  // namespace

TEST_CASE("smoothing spline: points on a line stay there, however smooth", "[deform]") {
  const double smoothing = GENERATE(0.0, 1e-6, 1.0, 1e9, kInfinity);
  CAPTURE(smoothing);
  const Points points = {{3, 7}, {0.5, 2}, {0.6, 2.2}, {3, 7}, {-1, -1}};
  const SmoothingSpline spline = smoothing_spline(points, smoothing);
  for (const double x : {-1.0, 0.0, 0.55, 2.9, 3.0}) CHECK(spline.value(x) == Approx(1 + 2 * x));
  CHECK(spline.leave_one_out_error < 1e-12);
}

TEST_CASE("smoothing spline: without smoothing it meets the mean at every x", "[deform]") {
  const Points points = scattered_points(3);
  const SmoothingSpline spline = smoothing_spline(points, 0);
  REQUIRE(spline.knots.size() == 12);
  CHECK(spline.value(points[0].x) == Approx((points[0].y + 0.8) / 3).epsilon(1e-12));
  for (std::size_t i = 1; i < 12; ++i)
    CHECK(spline.value(points[i].x) == Approx(points[i].y).epsilon(1e-12));
}

TEST_CASE("smoothing spline: infinitely smooth it is the line of least squares", "[deform]") {
  const Points points = scattered_points(4);
  Eigen::MatrixX2d rows(points.size(), 2);
  Eigen::VectorXd y(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) << 1, points[i].x;
    y[static_cast<Eigen::Index>(i)] = points[i].y;
  }
  const Eigen::Vector2d line = rows.colPivHouseholderQr().solve(y);
  const SmoothingSpline spline = smoothing_spline(points, kInfinity);
  CHECK(spline.shape == CurveShape::straight);
  for (const double share : {0.0, 0.3, 1.0}) {
    const double x = spline.low() + share * (spline.high() - spline.low());
    CAPTURE(x);
    CHECK(spline.value(x) == Approx(line[0] + line[1] * x).epsilon(1e-12));
    CHECK(smoothing_spline(points, 1e10).value(x) == Approx(spline.value(x)).epsilon(1e-6));
  }
}

TEST_CASE("smoothing spline: it is the minimiser that cubic kernels find", "[deform]") {
  const auto seed = GENERATE(range(0, 4));
  const double smoothing = GENERATE(1e-5, 1e-3, 0.1, 10.0);
  CAPTURE(seed, smoothing);
  const Points points = scattered_points(static_cast<std::uint64_t>(seed));
  const SmoothingSpline spline = smoothing_spline(points, smoothing);
  const CubicKernels kernels(points, per_x(spline));
  for (int i = 0; i <= 50; ++i) {
    const double x = spline.low() + (spline.high() - spline.low()) * i / 50;
    CAPTURE(x);
    CHECK(spline.value(x) == Approx(kernels.value(x)).margin(1e-8));
  }
}

TEST_CASE("smoothing spline: the leave-one-out error is that of refits without each point",
          "[deform]") {
  const auto seed = GENERATE(range(0, 4));
  const double smoothing = GENERATE(0.0, 1e-5, 1e-3, 0.1, 10.0);
  CAPTURE(seed, smoothing);
  const Points points = scattered_points(static_cast<std::uint64_t>(seed));
  const SmoothingSpline spline = smoothing_spline(points, smoothing);
  CHECK(spline.leave_one_out_error ==
        Approx(brute_force_error(points, per_x(spline))).epsilon(1e-6));
}

TEST_CASE("smoothing spline: no smoothing of a fine grid is off by less than the chosen one",
          "[deform]") {
  const auto seed = GENERATE(range(0, 6));
  CAPTURE(seed);
  Points points = scattered_points(static_cast<std::uint64_t>(seed));
  for (CurvePoint& point : points) point.y += 0.5 * std::sin(1.5 * point.x);
  const double least = best_smoothing_spline(points).leave_one_out_error;
  for (int i = -300; i <= 150; ++i) {
    CAPTURE(i);
    CHECK(smoothing_spline(points, std::pow(10, 0.03 * i)).leave_one_out_error >=
          least * (1 - 1e-9));
  }
  CHECK(smoothing_spline(points, 0).leave_one_out_error >= least);
  CHECK(smoothing_spline(points, kInfinity).leave_one_out_error >= least);
}

TEST_CASE("smoothing spline: smooth waves are followed, closer than any smoothing allows",
          "[deform]") {
  const Points points = waves(15);
  const SmoothingSpline spline = best_smoothing_spline(points);
  CHECK(spline.shape == CurveShape::curved);
  CHECK(std::sqrt(mean_of_squares(points, spline)) < 1e-3);
}

TEST_CASE("smoothing spline: a rough line is taken for a line", "[deform]") {
  const auto line = [](double x) { return 2 - 3 * x; };
  const SmoothingSpline spline = best_smoothing_spline(rough(line, 0.2));
  CHECK(spline.shape == CurveShape::straight);
  // The bumps of fifteen points tilt it by a few percent of their height.
  CHECK(spline.value(0.35) == Approx(line(0.35)).margin(0.1 * 0.2));
}

TEST_CASE("smoothing spline: where x tells nothing it is the mean", "[deform]") {
  const Points points = rough([](double) { return 0.4; }, 0.3);
  const SmoothingSpline spline = best_smoothing_spline(points);
  CHECK(spline.shape == CurveShape::level);
  // Eight bumps down, seven up.
  for (const double x : {0.0, 0.77, 1.4}) CHECK(spline.value(x) == Approx(0.4 - 0.3 / 15));
  // Each is off from the mean of the other fourteen by 15/14 of what it is off from the mean.
  CHECK(spline.leave_one_out_error ==
        Approx(15.0 / 14 * std::sqrt(mean_of_squares(points, spline))).epsilon(1e-12));
}

TEST_CASE("smoothing spline: beyond its knots it stays at the last one's value", "[deform]") {
  const SmoothingSpline spline = smoothing_spline(scattered_points(1), 1e-3);
  CHECK(spline.value(spline.low() - 100) == spline.value(spline.low()));
  CHECK(spline.value(HUGE_VAL) == spline.value(spline.high()));
  CHECK(spline.value(spline.low()) != spline.value(spline.high()));
  CHECK(spline.value(spline.high()) == Approx(spline.knots.back().value).epsilon(1e-14));
}

TEST_CASE("smoothing spline: points that no curve goes through are refused", "[deform]") {
  CHECK_THROWS_AS(smoothing_spline({}, 1), ContractError);
  CHECK_THROWS_AS(best_smoothing_spline(Points{{0, 1}, {1, 2}, {1, 3}}), ContractError);
  CHECK_THROWS_AS(smoothing_spline(Points{{0, 1}, {1, kNotANumber}, {2, 3}}, 1), ContractError);
  CHECK_THROWS_AS(smoothing_spline(Points{{0, 1}, {kInfinity, 2}, {2, 3}}, 1), ContractError);
  CHECK_THROWS_AS(smoothing_spline(waves(5), -1), ContractError);
  CHECK_THROWS_AS(smoothing_spline(waves(5), kNotANumber), ContractError);
  CHECK_THROWS_AS(smoothing_spline(waves(5), 1).value(kNotANumber), ContractError);
}

}  // namespace pleat
