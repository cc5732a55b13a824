#pragma once

#include <vector>

#include "core/dynamics/position_based/lane_layout.h"
#include "core/dynamics/position_based/lane_operations.h"
#include "core/model/cloth_model.h"

namespace pleat {

/// Operations first to first + n_springs - 1 form a line: the second end of each is the first end
/// of the next.
struct SpringLine {
  int first, n_springs;
};

/// The operations of a sweep over springs, in order: first the lines, then the others.
struct SpringOrder {
  std::vector<LaneOperation> operations;
  std::vector<SpringLine> lines;
};

/// Orders springs. Lines run across the rows of the layout, away from the pins, or along its only
/// row; where cloth closes to a tube, which is squeezed and widened as a whole, along the rows too.
/// Then come the diagonals, then springs along the rows.
///
/// springs  indices of those to order
SpringOrder order_springs(const ClothModel& model, const LaneLayout& layout,
                          const std::vector<int>& springs);

}  // namespace pleat
