#pragma once

#include "core/dynamics/position_based/lanes/hanging_program.h"
#include "core/dynamics/position_based/levels/gathered_bends.h"
#include "core/dynamics/position_based/levels/gathered_springs.h"
#include "core/dynamics/position_based/levels/gathered_vertices.h"

namespace pleat {

/// The constraints of a cloth's own mesh, whatever that is, one after the other: springs in sets
/// that share no vertex, four at a time.
struct GatheredSweeps {
  GatheredSprings springs;
  GatheredBends bends;
  HangingProgram hanging;

  /// h  substep [s]
  GatheredSweeps(const ClothModel& model, const LaneLayout& layout, SpringLaw law, double h);

  /// Take over pins that changed in number or vertex, and rest lengths. Allocate nothing.
  void refresh_pins(const float* inverse_masses);
  void refresh_rest_lengths(const ClothModel& model);

  /// Projects each constraint once. The first sweep of a substep starts from multipliers of zero.
  void sweep(GatheredVertices& vertices, const Relaxation& relaxation, bool is_first);
  /// Makes the multipliers zero.
  void forget();
  /// See Projections.
  double squared_residual(GatheredVertices& vertices) const;
};

}  // namespace pleat
