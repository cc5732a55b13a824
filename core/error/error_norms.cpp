#include "core/error/error_norms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/check.h"

namespace pleat {

double root_mean_square(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

double position_error(const PositionsView& positions, const PositionsView& reference,
                      const VectorView& areas) {
  const Eigen::Index n = std::min(positions.cols(), reference.cols());
  PLEAT_CHECK(areas.size() == n && n > 0, "one area for each point that both states have");
  double sum = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    sum += areas[i] * (positions.col(i) - reference.col(i)).squaredNorm();
  return std::sqrt(sum / areas.sum());
}

double position_error_95(const PositionsView& positions, const PositionsView& reference,
                         const VectorView& areas) {
  constexpr double kShare = 0.95;
  const Eigen::Index n = std::min(positions.cols(), reference.cols());
  PLEAT_CHECK(areas.size() == n && n > 0, "one area for each point that both states have");
  if (!(areas.sum() > 0)) return std::numeric_limits<double>::quiet_NaN();
  const Eigen::VectorXd distances =
      (positions.leftCols(n) - reference.leftCols(n)).colwise().norm();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return distances[a] < distances[b]; });
  double within = 0;
  for (const Eigen::Index i : order)
    if ((within += areas[i]) >= kShare * areas.sum()) return distances[i];
  return distances[order.back()];
}

// With d_k = |x_k - x_{k+1}| falling by 2^p at each halving, x - x_3 = (x_3 - x_2) / (2^p - 1).
MeshLimit observed_limit(const std::array<Positions, 3>& meshes, const VectorView& areas) {
  const Eigen::Index n = meshes[0].cols();
  PLEAT_CHECK(meshes[1].cols() >= n && meshes[2].cols() >= n, "finer meshes have more vertices");
  MeshLimit limit;
  for (std::size_t k = 0; k < 2; ++k)
    limit.distances[k] = position_error(meshes[k].leftCols(n), meshes[k + 1].leftCols(n), areas);
  limit.rate = std::log2(limit.distances[0] / limit.distances[1]);
  const double share =
      limit.rate > 0 ? 1 / (std::exp2(limit.rate) - 1) : std::numeric_limits<double>::quiet_NaN();
  const auto fine = meshes[2].leftCols(n);
  limit.positions = fine + share * (fine - meshes[1].leftCols(n));
  return limit;
}

}  // namespace pleat
