#pragma once

#include <vector>

#include "core/dynamics/position_based/spring_law.h"

namespace pleat {

/// Bending elements of a thread that follow on one another: element i bends the vertices i, i + 1
/// and i + 2 of the chain, C = before (x_i - x_(i+1)) + after (x_(i+2) - x_(i+1)).
struct BendChain {
  struct Bend {
    float before, after;  ///< weights relative to the middle one's
    float compliance;     ///< mean mass / (stiffness h^2)
    int element;          ///< index among the bending elements that resist
  };
  std::vector<VertexId> vertices;  ///< all different; two more than bends
  std::vector<Bend> bends;
};

/// Sorts elements that join no hanging vertex into chains as long as they go. A ring is cut: its
/// last two elements are a chain of their own.
///
/// bends  those of the model that resist
std::vector<BendChain> bend_chains(const ClothModel& model,
                                   const std::vector<BendConstraint>& bends);

/// The factor L D L^T of a chain's J W J^T + alpha, with W the inverse masses of its vertices and
/// alpha the compliances: element i reads 1 on the diagonal of L, and these beside it.
struct BendChainFactor {
  struct Row {
    double next_but_one = 0, next = 0;  ///< L_(i, i-2), L_(i, i-1)
    double inverse_pivot = 0;           ///< 1 / D_i
  };
  std::vector<Row> rows;
};

/// inverse_masses  of the chain's vertices, see LaneView
BendChainFactor bend_chain_factor(const BendChain& chain,
                                  const std::vector<double>& inverse_masses);

}  // namespace pleat
