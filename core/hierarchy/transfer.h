#pragma once

#include <cstdint>
#include <vector>

#include "core/base/ids.h"
#include "core/base/vec.h"

namespace pleat {

/// How a vertex takes its correction from the coarser vertices around it.
enum class TransferWeights {
  /// Square of the inverse distance: never negative; constants come exactly, linear fields roughly.
  inverse_distance,
  /// Moving least squares with those weights: linear fields come exactly too along the directions
  /// in which the coarser vertices lie; weights may be negative.
  moving_least_squares,
};

/// Interpolation from the vertices of a coarser level to those of a finer one, as rows of weights
/// that sum to 1.
struct Transfer {
  struct Term {
    VertexId coarse;
    double weight;
  };
  std::vector<std::int32_t> begin{0};  ///< first term of each finer vertex; one more at the end
  std::vector<Term> terms;

  int n_rows() const { return static_cast<int>(begin.size()) - 1; }

  /// fine  3 x n_rows, coarse  3 x columns
  Positions operator*(const Positions& coarse) const;
};

/// kept       coarser vertices by their numbers among the finer ones, ascending
/// neighbours of each finer vertex, by edges of the finer level
/// positions  of the finer vertices at rest [m]
///
/// A kept vertex is its own parent. Parents of another one are the kept ones beside it; if they are
/// fewer than two, those of the next ring too, and so on. A parent in the same place takes all the
/// weight. Throws ContractError when a vertex finds none.
Transfer transfer_between(const std::vector<VertexId>& kept,
                          const std::vector<std::vector<VertexId>>& neighbours,
                          const Positions& positions, TransferWeights weights);

/// Largest distance [m] between a vertex at rest and where its parents' places put it: how wrong
/// linear fields come.
double linear_error(const Transfer& transfer, const Positions& coarse, const Positions& fine);

}  // namespace pleat
