#pragma once

#include <array>
#include <vector>

#include "core/base/ids.h"
#include "core/base/vec.h"

namespace pleat {

/// Edges of a level, by their ends' numbers in the finest mesh, and where the strain of each stands
/// in an array.
struct StrainedEdges {
  std::vector<std::array<VertexId, 2>> ends;
  std::vector<int> places;
};

/// Strains of a coarser level's edges as means of those of the finer one. A finer edge counts where
/// it meets an end of the coarser one, by the eighth power of the cosine between them at rest:
/// nearly along it.
struct StrainRows {
  std::vector<int> targets;  ///< places of the coarser edges
  std::vector<int> row_ends;
  std::vector<int> columns;  ///< places of finer edges
  std::vector<double> weights;

  /// Coarser edges that nothing is near keep what `to` holds.
  template <class Real>
  void apply(const Real* from, Real* to) const {
    int term = 0;
    for (std::size_t row = 0; row < targets.size(); ++row) {
      Real sum = 0;
      for (; term < row_ends[row]; ++term)
        sum += static_cast<Real>(weights[static_cast<std::size_t>(term)]) *
               from[columns[static_cast<std::size_t>(term)]];
      to[targets[row]] = sum;
    }
  }
};

/// rest  places of the finest mesh [m]
StrainRows strain_rows(const StrainedEdges& coarser, const StrainedEdges& finer,
                       const Positions& rest);

}  // namespace pleat
