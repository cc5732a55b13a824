#pragma once

#include <cstdint>
#include <vector>

#include "core/refinement/bend_features.h"

namespace pleat {

struct PatternOptions {
  int n_patterns = 3;      ///< 1 to kMaxPatterns
  bool normalised = true;  ///< both components count alike, however strongly the fabric bends
  std::uint64_t seed = 1;
  /// Runs of k-means, at least 1; the best counts. Where one finds the best clusters with
  /// probability p, all miss them with (1 - p)^n_runs.
  int n_runs = 16;

  /// Throws InputError naming the value out of range.
  void validate() const;
};
constexpr int kMaxPatterns = 16;

/// Kinds of motion that an example's vertices show, from 0, the calmest, to the most bent.
struct BendPatterns {
  std::vector<int> of_vertices;
  BendFeatures centres;        ///< a column for each pattern [1/m]
  Eigen::Vector2d low{0, 0};   ///< features that clustering maps to 0 [1/m]
  Eigen::Vector2d high{1, 1};  ///< features that clustering maps to 1 [1/m]
};

/// Clusters features, ranked by the length of their centre as it was clustered. Same features, same
/// options, same patterns.
///
/// Throws InputError for options out of range and when fewer vertices than patterns differ.
BendPatterns bend_patterns(const BendFeatures& features, const PatternOptions& options = {});

}  // namespace pleat
