#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/base/part_observer.h"
#include "core/linalg/linear_solver.h"
#include "core/model/cloth_model.h"
#include "core/model/state.h"
#include "core/model/system_matrix.h"

namespace pleat {

/// How a linearly implicit substep ends, once its matrix and right-hand side are there: A dv = b
/// with the velocity changes of pins prescribed, then v += dv and x += h v.
class VelocitySolve {
 public:
  /// model  outlives it
  /// kind   of the solver
  VelocitySolve(const ClothModel& model, SolverKind kind, std::unique_ptr<LinearSolver> solver);

  /// Call it once for each pattern, before choose_pins.
  void analyze(const SystemMatrix& matrix);
  /// Call it when pins have changed in number or vertex.
  void choose_pins(SystemMatrix& matrix);
  /// Sets the relative residual at which an iterative solver stops.
  void set_tolerance(double tolerance) { solver_->set_tolerance(tolerance); }

  /// Finds by how much velocities change in h [s], to `time_end`. An iterative solver starts from
  /// what the last changes lead to, and what it leaves has no momentum. Where it gives up, a factor
  /// solves in its place, in some of the next substeps too, and the report says so. The residual is
  /// relative to the right-hand side or to what weight does in the substep, whichever is larger.
  /// Matrix, reduced to parents, and right-hand side [N s] are changed. The observer may be null.
  SolveReport find_changes(SystemMatrix& matrix, Positions& rhs, const State& state,
                           double time_end, double h, PartObserver* observer);
  /// Finds them once more in the substep, for another matrix and right-hand side of free vertices.
  SolveReport find_changes_again(const SystemMatrix& matrix, const Positions& rhs,
                                 const State& state, double h, PartObserver* observer);
  const Positions& changes() const { return change_; }  ///< [m/s]
  /// Moves the state by the changes that were found.
  void move(State& state, double time_end, double h);

  /// Finds the changes and moves the state, unless the report ends the run.
  SolveReport advance(SystemMatrix& matrix, Positions& rhs, State& state, double time_end, double h,
                      PartObserver* observer);

 private:
  /// Solves for the changes of velocities.
  SolveReport solve(const SystemMatrix& matrix, const Positions& rhs, const State& state,
                    PartObserver* observer);
  SolveReport solve_as_asked(const SystemMatrix& matrix, const Positions& rhs, const State& state,
                             PartObserver* observer);
  SolveReport solve_in_its_place(const SystemMatrix& matrix, const Positions& rhs,
                                 PartObserver* observer);
  /// Moves all free vertices by what the solver left of their momentum.
  void keep_momentum(const SystemMatrix& matrix, const Positions& rhs);
  /// The polynomial through the last changes, at the next substep.
  void guess();
  /// Takes the degree that would have come nearest to the last change.
  void learn();

  const ClothModel& model_;
  SolverKind kind_;
  std::unique_ptr<LinearSolver> solver_;
  std::unique_ptr<LinearSolver> factor_;  // null until an iterative solver gives up
  int n_in_its_place_ = 0;                // substeps left that are the factor's
  Positions change_;                      // change of velocities [m/s]
  std::array<Positions, 4>
      differences_;  // backward, of the last changes; the first is the last one
  Positions difference_;
  std::size_t degree_ = 0;     // degree of the polynomial
  Positions pin_changes_;      // prescribed, one column per pin
  std::vector<char> is_free_;  // neither pinned nor hanging, for each vertex
};

}  // namespace pleat
