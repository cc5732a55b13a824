#include "core/deform/measure_fit.h"

#include <Eigen/Core>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/check.h"
#include "core/deform/fabric_weights.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

using Fabrics = std::vector<Fabric>;

const MeasureFit& shipped_fit() {
  static const MeasureFit fit(fabric_library().fabrics);
  return fit;
}

/// Place in the order of size from 1; those that tie share the mean of their places.
std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<double> places;
  for (const double value : values) {
    double place = 0.5;
    for (const double other : values) place += other < value ? 1 : other == value ? 0.5 : 0;
    places.push_back(place);
  }
  return places;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<Eigen::Index>(a.size());
  Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(a.data(), n);
  Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(b.data(), n);
  x.array() -= x.mean();
  y.array() -= y.mean();
  return x.dot(y) / (x.norm() * y.norm());
}

double rank_correlation(double GeometricMeasures::*value) {
  std::vector<double> raw;
  std::vector<double> normalised;
  for (const Fabric& fabric : fabric_library().fabrics) {
    raw.push_back(fabric.measured.*value);
    normalised.push_back(fabric.normalised.*value);
  }
  return correlation(ranks(raw), ranks(normalised));
}

double square_of_difference(const DeformWeights& a, const DeformWeights& b) {
  return std::pow(a.recovery - b.recovery, 2) + std::pow(a.stretch - b.stretch, 2) +
         std::pow(a.bending - b.bending, 2);
}

GeometricMeasures mean_normalised(const Fabrics& fabrics) {
  GeometricMeasures mean;
  for (const Fabric& fabric : fabrics)
    for (const MeasureField& measure : kMeasures)
      mean.*measure.value += fabric.normalised.*measure.value / static_cast<double>(fabrics.size());
  return mean;
}

/// Sums of squares over fabrics: what a guess at their v' is off by.
struct Misses {
  GeometricMeasures squares;
  double weight_squares = 0;
  int n = 0;

  void add(const GeometricMeasures& guess, const Fabric& fabric) {
    for (const MeasureField& measure : kMeasures)
      squares.*measure.value +=
          std::pow(guess.*measure.value - fabric.normalised.*measure.value, 2);
    weight_squares +=
        square_of_difference(recomputed_weights(guess), recomputed_weights(fabric.normalised));
    ++n;
  }

  void check(const GeometricMeasures& expected, double expected_of_weights) const {
    CHECK(std::sqrt(squares.recovery / n) == Approx(expected.recovery).margin(5e-4));
    CHECK(std::sqrt(squares.stretch / n) == Approx(expected.stretch).margin(5e-4));
    CHECK(std::sqrt(squares.bending / n) == Approx(expected.bending).margin(5e-4));
    CHECK(std::sqrt(weight_squares / n) == Approx(expected_of_weights).margin(5e-4));
  }
};

struct BadMeasures {
  GeometricMeasures raw;
  const char* where;
  const char* sentence;
};

void check_refused(const MeasureFit& fit, const BadMeasures& bad) {
  try {
    fit.fit(bad.raw);
    FAIL_CHECK("was accepted");
  } catch (const InputError& error) {
    CHECK(error.where() == bad.where);
    CHECK(error.sentence() == bad.sentence);
  }
}

}  // namespace

TEST_CASE("measure fit: raw measures hardly rank fabrics as their normalised ones do", "[deform]") {
  CHECK(rank_correlation(&GeometricMeasures::recovery) == Approx(0.2453).margin(5e-5));
  CHECK(rank_correlation(&GeometricMeasures::stretch) == Approx(0.3005).margin(5e-5));
  CHECK(rank_correlation(&GeometricMeasures::bending) == Approx(0.2256).margin(5e-5));
}

TEST_CASE("measure fit: the curves through the measured fabrics miss one left out by this much",
          "[deform]") {
  const auto& [recovery, stretch, bending] = shipped_fit().curves();
  CHECK(recovery.leave_one_out_error == Approx(0.2552).margin(5e-5));
  CHECK(stretch.leave_one_out_error == Approx(0.3260).margin(5e-5));
  CHECK(bending.leave_one_out_error == Approx(0.3076).margin(5e-5));
  CHECK(recovery.smoothing == Approx(0.00727).epsilon(1e-3));
  CHECK(bending.smoothing == Approx(0.00811).epsilon(1e-3));
  // For stretch the mean tells more than any curve, the best of which is a line.
  CHECK(stretch.shape == CurveShape::level);
  CHECK(stretch.value(1.05) == Approx(0.2872).margin(5e-5));
  std::vector<CurvePoint> points;
  for (const Fabric& fabric : fabric_library().fabrics)
    points.push_back({fabric.measured.stretch, fabric.normalised.stretch});
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double line_error = smoothing_spline(points, kInfinity).leave_one_out_error;
  CHECK(line_error == Approx(0.3493).margin(5e-5));
  CHECK(smoothing_spline(points, 1).leave_one_out_error > line_error);
}

TEST_CASE("measure fit: of a fabric that it has not seen it tells a little more than the mean",
          "[deform]") {
  Misses fit, mean, nearest;
  for (std::size_t i = 0; i < fabric_library().fabrics.size(); ++i) {
    Fabrics others = fabric_library().fabrics;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const Fabric& unseen = fabric_library().fabrics[i];
    const FittedWeights fitted = MeasureFit(others).fit(unseen.measured);
    fit.add(fitted.normalised, unseen);
    mean.add(mean_normalised(others), unseen);
    nearest.add(others[fitted.nearest].normalised, unseen);
  }
  fit.check({0.298, 0.389, 0.301}, 0.363);
  mean.check({0.329, 0.326, 0.390}, 0.388);
  nearest.check({0.482, 0.400, 0.397}, 0.462);
}

TEST_CASE("measure fit: each measured fabric is the nearest to its own measures", "[deform]") {
  const Fabrics& fabrics = fabric_library().fabrics;
  for (std::size_t i = 0; i < fabrics.size(); ++i) {
    CAPTURE(fabrics[i].name);
    const FittedWeights fitted = shipped_fit().fit(fabrics[i].measured);
    CHECK(fitted.nearest == i);
    CHECK(fitted.distance == 0);
    CHECK(fitted.clamped.empty());
  }
}

TEST_CASE("measure fit: distance is in standard deviations of the measured fabrics", "[deform]") {
  Fabrics fabrics(4);
  const double recovery[] = {0.8, 0.9, 1.0, 1.1};  // deviation: sqrt(0.05)/2
  const double stretch[] = {1, 2, 3, 4};           // sqrt(5)/2
  for (std::size_t i = 0; i < fabrics.size(); ++i) {
    fabrics[i].measured = {recovery[i], stretch[i], stretch[i]};
    fabrics[i].normalised = {0.5, 0.5, 0.5};
  }
  const FittedWeights fitted = MeasureFit(fabrics).fit({0.93, 2.4, 2});
  CHECK(fitted.nearest == 1);
  CHECK(fitted.distance == Approx(std::hypot(0.03 / std::sqrt(0.0125), 0.4 / std::sqrt(1.25))));
}

TEST_CASE("measure fit: weights follow by formula from values within zero and one", "[deform]") {
  for (int i = 0; i <= 100; ++i) {
    const double share = i / 100.0;
    const FittedWeights fitted =
        shipped_fit().fit({0.94 + 0.06 * share, 1.13 - 0.13 * share, 0.98 + 0.025 * share});
    CAPTURE(share);
    for (const MeasureField& measure : kMeasures) {
      CHECK(fitted.normalised.*measure.value >= 0);
      CHECK(fitted.normalised.*measure.value <= 1);
    }
    CHECK(square_of_difference(fitted.weights, recomputed_weights(fitted.normalised)) == 0);
    CHECK(fitted.weights.recovery + fitted.weights.stretch + fitted.weights.bending ==
          Approx(1).epsilon(1e-14));
  }
  // The curve of recovery ends above one, on the side of gabardine.
  CHECK(shipped_fit().curves()[0].value(0.95) > 1);
  CHECK(shipped_fit().fit({0.95, 1.05, 0.995}).normalised.recovery == 1);
}

TEST_CASE("measure fit: a value beyond the measured ones is named and taken at the nearer end",
          "[deform]") {
  const FittedWeights beyond = shipped_fit().fit({2, 1.05, 0.5});
  CHECK(beyond.clamped == std::vector<std::string_view>{"recovery", "bending"});
  CHECK(beyond.measured_low.recovery == 0.95);
  CHECK(beyond.measured_high.recovery == 0.9937);
  CHECK(beyond.measured_low.stretch == 1.0101);
  CHECK(beyond.measured_high.stretch == 1.1242);
  CHECK(beyond.measured_low.bending == 0.9871);
  CHECK(beyond.measured_high.bending == 0.9998);
  const FittedWeights at_end = shipped_fit().fit({0.9937, 1.05, 0.9871});
  CHECK(at_end.clamped.empty());
  CHECK(square_of_difference(beyond.weights, at_end.weights) == 0);
  CHECK(beyond.distance > at_end.distance);
}

TEST_CASE("measure fit: each error stands beside its own measure", "[deform]") {
  const FittedWeights fitted = shipped_fit().fit({0.97, 1.05, 0.995});
  for (std::size_t m = 0; m < kMeasures.size(); ++m)
    CHECK(fitted.leave_one_out_error.*kMeasures[m].value ==
          shipped_fit().curves()[m].leave_one_out_error);
}

TEST_CASE("measure fit: measurements that are none are refused by name", "[deform]") {
  constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
  const BadMeasures bad_measures[] = {
      {{kNotANumber, 1, 1}, "/recovery", "expected a finite number > 0, got nan"},
      {{0.9, 0, 1}, "/stretch", "expected a finite number > 0, got 0"},
      {{0.9, 1, -0.5}, "/bending", "expected a finite number > 0, got -0.5"},
      {{HUGE_VAL, 1, 1}, "/recovery", "expected a finite number > 0, got inf"}};
  for (const BadMeasures& bad : bad_measures) check_refused(shipped_fit(), bad);
}

TEST_CASE("measure fit: where every curve is at zero there are no weights", "[deform]") {
  Fabrics fabrics(3);
  for (int i = 0; i < 3; ++i) {
    const double v = 1 + 0.1 * i;
    fabrics[static_cast<std::size_t>(i)].measured = {v, v, v};
  }
  check_refused(MeasureFit(fabrics), {{1, 1, 1},
                                      "",
                                      "expected measures that the measured fabrics give a weight, "
                                      "got three whose fitted values are 0"});
}

TEST_CASE("measure fit: too few different fabrics are refused", "[deform]") {
  Fabrics fabrics(4);
  for (int i = 0; i < 4; ++i)
    fabrics[static_cast<std::size_t>(i)].measured = {1 + 0.1 * i, i < 2 ? 1.0 : 2.0, 1 + 0.1 * i};
  try {
    MeasureFit fit(fabrics);
    FAIL_CHECK("was accepted");
  } catch (const InputError& error) {
    CHECK(error.where() == "/fabrics");
    CHECK(error.sentence() == "expected at least 3 different values of stretch, got 2");
  }
}

}  // namespace pleat
