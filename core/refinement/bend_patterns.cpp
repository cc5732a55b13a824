#include "core/refinement/bend_patterns.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "core/base/check.h"
#include "core/refinement/k_means.h"

namespace pleat {
namespace {

/// Clusters from the shortest centre to the longest.
std::vector<int> ranking(const PlanePoints& centres) {
  std::vector<int> order(static_cast<std::size_t>(centres.cols()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return centres.col(a).squaredNorm() < centres.col(b).squaredNorm();
  });
  return order;
}

}  // namespace

void PatternOptions::validate() const {
  if (n_patterns < 1 || n_patterns > kMaxPatterns)
    throw InputError("number of patterns", "expected a whole number from 1 to " +
                                               std::to_string(kMaxPatterns) + ", got " +
                                               std::to_string(n_patterns));
  if (n_runs < 1)
    throw InputError("number of runs", "expected at least 1, got " + std::to_string(n_runs));
}

BendPatterns bend_patterns(const BendFeatures& features, const PatternOptions& options) {
  options.validate();
  PLEAT_CHECK(features.cols() > 0 && features.allFinite(), "features are there and finite");
  BendPatterns patterns;
  if (options.normalised) {
    patterns.low = features.rowwise().minCoeff();
    patterns.high = features.rowwise().maxCoeff();
  }
  // A feature that is the same at all vertices tells nothing and becomes 0.
  const Eigen::Array2d range = patterns.high - patterns.low;
  const Eigen::Array2d per_unit = (range > 0).select(range.inverse(), 0);
  const PlanePoints points = per_unit.matrix().asDiagonal() * (features.colwise() - patterns.low);
  Random random(options.seed);
  const Clusters clusters = k_means(points, options.n_patterns, options.n_runs, random);
  const std::vector<int> order = ranking(clusters.centres);
  std::vector<int> rank(order.size());
  patterns.centres.resize(2, options.n_patterns);
  for (int r = 0; r < options.n_patterns; ++r) {
    const int c = order[static_cast<std::size_t>(r)];
    rank[static_cast<std::size_t>(c)] = r;
    patterns.centres.col(r) =
        patterns.low + Eigen::Vector2d(range * clusters.centres.col(c).array());
  }
  patterns.of_vertices.reserve(clusters.of_points.size());
  for (const int c : clusters.of_points)
    patterns.of_vertices.push_back(rank[static_cast<std::size_t>(c)]);
  return patterns;
}

}  // namespace pleat
