#include "core/deform/fabric_weights.h"

#include <cmath>

#include "core/base/check.h"

namespace pleat {

DeformWeights recomputed_weights(const GeometricMeasures& normalised) {
  const auto& [recovery, stretch, bending] = normalised;
  const double sum = recovery + stretch + bending;
  PLEAT_CHECK(recovery >= 0 && stretch >= 0 && bending >= 0, "no measure is negative");
  PLEAT_CHECK(sum > 0 && std::isfinite(sum), "the sum of the measures is positive and finite");
  return {recovery / sum, stretch / sum, bending / sum};
}

}  // namespace pleat
