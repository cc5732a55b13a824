#pragma once

#include <vector>

#include "core/dynamics/position_based/lane_operations.h"
#include "core/dynamics/position_based/levels/quad_vectors.h"

namespace pleat {

/// Begins and moves of a substep with the components of a vertex side by side, by slot, beside the
/// lanes that they come from. Moves are current in one of the two; who needs them asks for them.
class GatheredVertices {
 public:
  explicit GatheredVertices(int n_slots)
      : begins_(4 * static_cast<std::size_t>(n_slots), 0.0f), moves_(begins_) {}

  /// Takes what a view has, which is to outlive the projections of it.
  void begin(const LaneView& view);

  /// Moves as the last change left them, to be changed there.
  float* moves();
  const float* begins();
  const LaneView& lanes();
  /// Moves as they are, to be read only.
  const LaneView& lanes_to_read();
  std::size_t n_numbers() const { return moves_.size(); }  ///< count, of all moves

 private:
  LaneView view_{};
  bool has_begins_ = false;
  bool has_moves_ = false;  // current ones; else the lanes have
  std::vector<float> begins_, moves_;
};

}  // namespace pleat
