#include "core/measure/error_norms.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"

namespace pleat {
namespace {

/// l/L - 1.
double strain(const GaugeEdge& edge, const Eigen::Ref<const Positions>& positions) {
  return (positions.col(edge.a) - positions.col(edge.b)).norm() / edge.rest_length - 1;
}

}  // namespace

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

Stretch stretch(std::span<const GaugeEdge> gauge, const Eigen::Ref<const Positions>& positions) {
  if (gauge.empty()) return {};
  double sum = 0;
  double largest = 0;
  for (const GaugeEdge& edge : gauge) {
    const double e = std::abs(strain(edge, positions));
    sum += e * e;
    largest = std::max(largest, e);
  }
  return {std::sqrt(sum / static_cast<double>(gauge.size())), largest};
}

StrainMap::StrainMap(std::span<const GaugeEdge> gauge, int n_vertices)
    : gauge_(gauge.begin(), gauge.end()),
      inverse_counts_(static_cast<std::size_t>(n_vertices)),
      strains_(static_cast<std::size_t>(n_vertices)) {
  for (const GaugeEdge& edge : gauge_) {
    ++inverse_counts_[edge.a];
    ++inverse_counts_[edge.b];
  }
  for (float& count : inverse_counts_) count = count > 0 ? 1 / count : 0;
}

const std::vector<float>& StrainMap::update(const Eigen::Ref<const Positions>& positions) {
  PLEAT_CHECK(static_cast<std::size_t>(positions.cols()) == strains_.size(),
              "a strain map keeps its number of vertices");
  std::fill(strains_.begin(), strains_.end(), 0.0F);
  for (const GaugeEdge& edge : gauge_) {
    const auto e = static_cast<float>(strain(edge, positions));
    strains_[edge.a] += e;
    strains_[edge.b] += e;
  }
  for (std::size_t i = 0; i < strains_.size(); ++i) strains_[i] *= inverse_counts_[i];
  return strains_;
}

}  // namespace pleat
