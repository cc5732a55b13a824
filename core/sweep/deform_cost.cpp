#include "core/sweep/deform_cost.h"

#include "core/base/check.h"

namespace pleat {

DeformCost deform_cost(const DeformScene& scene) {
  const HeldVertices held = held_vertices(scene);
  PartTimer parts;
  DeformCost cost;
  const Stopwatch watch;
  DeformSolver solver(scene.mesh, scene.form, scene.weights());
  solver.hold(held.vertices);
  cost.build_ms = 1e3 * watch.elapsed();
  solver.observe(&parts);
  solver.restart(held.targets);
  cost.report = solver.solve();
  cost.total_ms = 1e3 * watch.elapsed();
  cost.n_linearisations = solver.n_linearisations();
  cost.n_steps = static_cast<int>(solver.steps().size());
  cost.assembly_ms = 1e3 * parts.total(Part::assembly) / cost.n_linearisations;
  cost.factor_ms = 1e3 * parts.total(Part::factor) / cost.n_linearisations;
  cost.solve_ms = 1e3 * parts.total(Part::solve) / std::max(1, cost.n_steps);
  cost.terms = solver.terms();
  cost.energy = cost.terms.weighted(scene.weights());
  return cost;
}

DragCost drag_cost(const DeformScene& scene, int n_moves) {
  PLEAT_CHECK(n_moves > 0, "a hand makes moves");
  const HeldVertices held = held_vertices(scene);
  Positions start(3, held.targets.cols());
  for (std::size_t k = 0; k < held.vertices.size(); ++k)
    start.col(static_cast<Eigen::Index>(k)) = scene.mesh.rest_positions.col(held.vertices[k]);
  DeformSolver hand(scene.mesh, scene.form, scene.weights());
  hand.hold(held.vertices);
  hand.restart(start);
  hand.solve();
  DeformSolver exact(scene.mesh, scene.form, scene.weights());
  exact.hold(held.vertices);
  exact.restart(start);
  DragCost cost;
  for (int move = 1; move <= n_moves; ++move) {
    const Positions places = start + (held.targets - start) * move / n_moves;
    const Stopwatch watch;
    hand.follow(places);
    cost.update_ms.push_back(1e3 * watch.elapsed());
    exact.move_held(places);
    exact.settle();
    cost.excess.push_back(hand.energy() / exact.energy() - 1);
  }
  return cost;
}

}  // namespace pleat
