#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace pleat {

/// Cost and error of a setting. NaN in either leaves the setting out.
struct CostAndError {
  double cost;   ///< [ms]
  double error;  ///< [m]
};

/// Indices of the points that no other point beats in one of the two without losing in the other,
/// from cheap to dear. Of points that are equal in both, the first.
std::vector<std::size_t> pareto_front(std::span<const CostAndError> points);

}  // namespace pleat
