#pragma once

#include <span>
#include <vector>

#include "core/scene/gauge.h"
#include "core/scene/rest_cloth.h"

namespace pleat {

/// Of one value or more.
double root_mean_square(std::span<const double> values);

/// RMS distance of the same material points of one cloth in two states at the same time [m].
///
/// positions, reference  [m]; column i is the same material point in both. One may be the finer
/// mesh: vertex i of a mesh
///                       is vertex i of its refinements, so the first columns are compared.
/// areas                 rest area of each compared point, all positive: weights, in any unit.
///
/// Throws ContractError unless `areas` has the smaller of both column counts.
double position_error(const Eigen::Ref<const Positions>& positions,
                      const Eigen::Ref<const Positions>& reference,
                      const Eigen::Ref<const Eigen::VectorXd>& areas);

/// |l/L - 1| over the edges of a gauge; 0 without any.
struct Stretch {
  double rms = 0;
  double largest = 0;
};

Stretch stretch(std::span<const GaugeEdge> gauge, const Eigen::Ref<const Positions>& positions);

/// The signed mean l/L - 1 of a gauge's edges at each vertex, for colouring.
class StrainMap {
 public:
  StrainMap(std::span<const GaugeEdge> gauge, int n_vertices);

  /// positions  [m]
  /// Returns one number per vertex, 0 where no edge ends; valid until the next call. Never
  /// allocates.
  const std::vector<float>& update(const Eigen::Ref<const Positions>& positions);

 private:
  std::vector<GaugeEdge> gauge_;
  std::vector<float> inverse_counts_;  // edges per vertex
  std::vector<float> strains_;
};

}  // namespace pleat
