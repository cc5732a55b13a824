#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "core/deform/smoothing_spline.h"
#include "core/fabric/fabric.h"

namespace pleat {

struct MeasureField {
  std::string_view name;
  double GeometricMeasures::*value;
};
constexpr std::array<MeasureField, 3> kMeasures{{{"recovery", &GeometricMeasures::recovery},
                                                 {"stretch", &GeometricMeasures::stretch},
                                                 {"bending", &GeometricMeasures::bending}}};

/// The weights that three measurements of a fabric make likely, and how far to trust them.
struct FittedWeights {
  DeformWeights weights;         ///< they add up to one
  GeometricMeasures normalised;  ///< v' on the curves, each within [0, 1]
  /// RMS by which a curve fitted to the other fabrics misses a measured one's v', of each curve;
  /// the same for any measurements.
  GeometricMeasures leave_one_out_error;
  GeometricMeasures measured_low;         ///< least v of the measured fabrics
  GeometricMeasures measured_high;        ///< largest v of the measured fabrics
  std::vector<std::string_view> clamped;  ///< names of those beyond, taken at the nearer end
  std::size_t nearest = 0;                ///< index of the fabric whose v are nearest
  /// How far that fabric is off, each v in units of its standard deviation over the fabrics.
  double distance = 0;
};

/// Maps measurements v to weights, by a curve through the measured fabrics' v' over their v for
/// each measure on its own. It claims no more than that: docs/methods/fabric_weights.md.
class MeasureFit {
 public:
  /// Throws InputError at /fabrics for fabrics with fewer than three different values of a measure.
  explicit MeasureFit(std::span<const Fabric> fabrics);

  /// v' over v, as in kMeasures.
  const std::array<SmoothingSpline, 3>& curves() const { return curves_; }

  /// Throws InputError at /recovery, /stretch or /bending unless that measurement is finite and
  /// positive, and for the whole when all three curves are at or below zero there: such
  /// measurements have no weights.
  FittedWeights fit(const GeometricMeasures& raw) const;

 private:
  std::vector<GeometricMeasures> measured_;
  std::array<SmoothingSpline, 3> curves_;
  GeometricMeasures spreads_;  // standard deviations
};

}  // namespace pleat
