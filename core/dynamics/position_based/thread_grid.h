#pragma once

#include <optional>
#include <vector>

#include "core/model/cloth_model.h"

namespace pleat {

/// A vertex in a grid.
struct GridPlace {
  int row = 0;
  int column = 0;
};

/// The grid that a cloth's threads are, also where it closes to a tube as a skirt does or parts
/// into legs: a row is a thread of one kind, or several of them, a column one of the other kind,
/// and threads side by side have columns that follow on one another. Rows are counted from the
/// pins, along the kind of thread that leads away from them, warp in doubt. Nothing where threads
/// branch or shift, as where cells are split, or where cloth has none.
std::optional<std::vector<GridPlace>> thread_grid(const ClothModel& model);

}  // namespace pleat
