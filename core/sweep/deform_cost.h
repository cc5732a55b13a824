#pragma once

#include <vector>

#include "core/deform/deform_solver.h"
#include "core/run/part_timer.h"
#include "core/scene/deform/deform_scene.h"

namespace pleat {

/// Cost of the least energy of a scene here, from its mesh to the end.
struct DeformCost {
  double total_ms = 0;
  double build_ms = 0;     ///< energy, pattern and symbolic factor, part of the total
  double assembly_ms = 0;  ///< matrix values of one linearisation
  double factor_ms = 0;    ///< numeric factor of one linearisation
  double solve_ms = 0;     ///< back-solve and corrections of one step
  int n_linearisations = 0;
  int n_steps = 0;
  double energy = 0;
  DeformTerms terms;
  SolveReport report;
};

DeformCost deform_cost(const DeformScene& scene);

/// A hand that takes all handles from rest to their targets in equal moves, with the shape kept up
/// by DeformSolver::follow.
struct DragCost {
  std::vector<double> update_ms;  ///< time of each move
  /// Energy after each move over the least found for the same places, minus one.
  std::vector<double> excess;
};

DragCost drag_cost(const DeformScene& scene, int n_moves);

}  // namespace pleat
