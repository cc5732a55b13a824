#include "core/measure/error_norms.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"

namespace pleat {
namespace {

bool is_structural(const Spring& spring) {
  return spring.kind != SpringKind::shear && spring.rest_length > 0;
}

/// l/L - 1.
double strain(const Spring& spring, const Eigen::Ref<const Positions>& positions) {
  return (positions.col(spring.a) - positions.col(spring.b)).norm() / spring.rest_length - 1;
}

}  // namespace

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

Stretch stretch(std::span<const Spring> springs, const Eigen::Ref<const Positions>& positions) {
  double sum = 0;
  double largest = 0;
  int count = 0;
  for (const Spring& spring : springs) {
    if (!is_structural(spring)) continue;
    const double e = std::abs(strain(spring, positions));
    sum += e * e;
    largest = std::max(largest, e);
    ++count;
  }
  return {count > 0 ? std::sqrt(sum / count) : 0, largest};
}

StrainMap::StrainMap(std::span<const Spring> springs, int n_vertices)
    : inverse_counts_(static_cast<std::size_t>(n_vertices)),
      strains_(static_cast<std::size_t>(n_vertices)) {
  for (const Spring& spring : springs) {
    if (!is_structural(spring)) continue;
    ++inverse_counts_[spring.a];
    ++inverse_counts_[spring.b];
  }
  for (float& count : inverse_counts_) count = count > 0 ? 1 / count : 0;
}

const std::vector<float>& StrainMap::update(std::span<const Spring> springs,
                                            const Eigen::Ref<const Positions>& positions) {
  PLEAT_CHECK(static_cast<std::size_t>(positions.cols()) == strains_.size(),
              "a strain map keeps its number of vertices");
  std::fill(strains_.begin(), strains_.end(), 0.0F);
  for (const Spring& spring : springs) {
    if (!is_structural(spring)) continue;
    const auto e = static_cast<float>(strain(spring, positions));
    strains_[spring.a] += e;
    strains_[spring.b] += e;
  }
  for (std::size_t i = 0; i < strains_.size(); ++i) strains_[i] *= inverse_counts_[i];
  return strains_;
}

}  // namespace pleat
