#include "core/deform/measure_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "core/base/check.h"
#include "core/base/formatted.h"
#include "core/deform/fabric_weights.h"

namespace pleat {
namespace {

std::vector<CurvePoint> curve_points(std::span<const Fabric> fabrics, const MeasureField& measure) {
  std::vector<CurvePoint> points;
  std::set<double> different;
  for (const Fabric& fabric : fabrics) {
    points.push_back({fabric.measured.*measure.value, fabric.normalised.*measure.value});
    different.insert(points.back().x);
  }
  if (different.size() < 3)
    throw InputError("/fabrics", "expected at least 3 different values of " +
                                     std::string(measure.name) + ", got " +
                                     std::to_string(different.size()));
  return points;
}

double standard_deviation(const std::vector<CurvePoint>& points) {
  const auto n = static_cast<double>(points.size());
  double mean = 0;
  for (const CurvePoint& point : points) mean += point.x / n;
  double variance = 0;
  for (const CurvePoint& point : points) variance += std::pow(point.x - mean, 2) / n;
  return std::sqrt(variance);
}

void check_measurement(const MeasureField& measure, double value) {
  if (value > 0 && std::isfinite(value)) return;
  throw InputError("/" + std::string(measure.name),
                   formatted("expected a finite number > 0, got %g", value));
}

}  // namespace

MeasureFit::MeasureFit(std::span<const Fabric> fabrics) {
  for (const Fabric& fabric : fabrics) measured_.push_back(fabric.measured);
  for (std::size_t m = 0; m < kMeasures.size(); ++m) {
    const std::vector<CurvePoint> points = curve_points(fabrics, kMeasures[m]);
    curves_[m] = best_smoothing_spline(points);
    spreads_.*kMeasures[m].value = standard_deviation(points);
  }
}

FittedWeights MeasureFit::fit(const GeometricMeasures& raw) const {
  FittedWeights fitted;
  for (std::size_t m = 0; m < kMeasures.size(); ++m) {
    const auto& [name, value] = kMeasures[m];
    const SmoothingSpline& curve = curves_[m];
    check_measurement(kMeasures[m], raw.*value);
    fitted.normalised.*value = std::clamp(curve.value(raw.*value), 0.0, 1.0);
    fitted.leave_one_out_error.*value = curve.leave_one_out_error;
    fitted.measured_low.*value = curve.low();
    fitted.measured_high.*value = curve.high();
    if (raw.*value < curve.low() || raw.*value > curve.high()) fitted.clamped.push_back(name);
  }
  const GeometricMeasures& normalised = fitted.normalised;
  if (normalised.recovery + normalised.stretch + normalised.bending == 0)
    throw InputError("",
                     "expected measures that the measured fabrics give a weight, got three "
                     "whose fitted values are 0");
  fitted.weights = recomputed_weights(normalised);

  fitted.distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < measured_.size(); ++i) {
    double square = 0;
    for (const auto& [name, value] : kMeasures)
      square += std::pow((raw.*value - measured_[i].*value) / (spreads_.*value), 2);
    if (std::sqrt(square) >= fitted.distance) continue;
    fitted.distance = std::sqrt(square);
    fitted.nearest = i;
  }
  return fitted;
}

}  // namespace pleat
