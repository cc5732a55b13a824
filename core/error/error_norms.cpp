#include "core/error/error_norms.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"

namespace pleat {
double root_mean_square(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double position_error(const Eigen::Ref<const Positions>& positions,
                      const Eigen::Ref<const Positions>& reference,
                      const Eigen::Ref<const Eigen::VectorXd>& areas) {
  const Eigen::Index n = std::min(positions.cols(), reference.cols());
  PLEAT_CHECK(areas.size() == n && n > 0, "one area for each point that both states have");
  double sum = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    sum += areas[i] * (positions.col(i) - reference.col(i)).squaredNorm();
  return std::sqrt(sum / areas.sum());
}

}  // namespace pleat
