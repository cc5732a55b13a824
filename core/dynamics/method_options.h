#pragma once

#include "core/hierarchy/mesh_hierarchy.h"
#include "core/linalg/linear_solver.h"

namespace pleat {

struct StepperType;

/// The rows of the table of steppers (stepper_table.h).
namespace steppers {
extern const StepperType kImplicitEuler, kImex, kProjective, kXpbd, kPbd, kHpbd, kMultigrid,
    kExplicitEuler, kRk4, kNewton;
}  // namespace steppers

/// The most substeps of a step: with steps of 1/60 s, 17 ns each.
constexpr int kMaxSubsteps = 1000000;
/// The most iterations of a substep.
constexpr int kMaxSweeps = 100000;
/// Stands for as many substeps as the stability bound asks for.
constexpr int kStableSubsteps = 0;

enum class Constraints {
  compliant,  ///< compliance 1/k
  rigid,      ///< compliance 0
  /// compliance 0, but diagonals of quads give way to the threads: the constraints of multigrid
  rigid_threads,
};

/// The equations that `newton` solves in a substep.
enum class NewtonRule {
  backward_euler,  ///< first order, loses energy
  midpoint,        ///< implicit midpoint: second order, keeps all energy: for small steps
  equilibrium,     ///< rest under the forces at the end of the substep, whatever the mass
};

/// Choice of the springs that `imex` treats implicitly.
enum class ImplicitSplit {
  by_stability,  ///< springs that symplectic Euler would not take stably in a substep
  structural,    ///< warp and weft, whatever the substep
};

/// Use that `projective` makes of its rounds.
enum class Acceleration {
  none,
  anderson,  ///< foretells from the last rounds where they lead
};

/// Velocities that `explicit` adds to the positions.
enum class EulerRule {
  symplectic,  ///< the new velocities
  forward,     ///< the old ones: without damping along every spring no step is stable
};

/// Response of an explicit stepper to substeps beyond its stability bound.
enum class BeyondBound {
  refuse,
  go_on,  ///< steps on until the numbers end the run
};

/// How pbd, hpbd and multigrid go over the constraints of a level once.
enum class Smoother {
  none,          ///< not at all
  jacobi,        ///< all from the same places; a vertex takes the mean of what they ask of it
  gauss_seidel,  ///< each sees what those before it did
  /// gauss_seidel, but the springs of a grid that follow on one another away from the pins are
  /// solved at once, as xpbd does. Other meshes and coarser levels take gauss_seidel itself.
  lines,
  sor,  ///< gauss_seidel, each correcting omega times what it asks for
};

/// Rest lengths of coarser levels.
enum class LevelLengths {
  /// The longest that strain-free cloth allows, and no shorter place is wrong: what satisfies the
  /// finest level stays as it is.
  surface,
  /// Distances at rest, kept to both sides: the form of the paper, which irons folds.
  chord,
  /// Lengths that the finer level's errors along them ask for, to both sides: what satisfies the
  /// finest level stays as it is, stretched as its multipliers say, and cycles converge.
  error,
};

/// Constraints that hold vertices from afar.
enum class Attachments {
  none,
  long_range,  ///< no further from a pin than strain-free cloth allows
};

/// The tolerance that newton, which makes references, starts from.
constexpr double kNewtonTolerance = 1e-10;

/// Largest carried_acceleration: with half of it carried nothing would be damped.
constexpr double kMostCarried = 0.4;

/// A stepper with its settings. Each stepper reads its step and the settings that its row of the
/// table names.
struct MethodOptions {
  const StepperType* stepper = &steppers::kImplicitEuler;  ///< not null
  double step = 1.0 / 60;                                  ///< [s], positive
  int substeps = 1;    ///< at least 1, or kStableSubsteps where the stepper has a stability bound
  int iterations = 1;  ///< projective: local/global rounds; xpbd and pbd: sweeps; hpbd and
                       ///< multigrid: cycles; at least 1
  SolverKind solver = SolverKind::cg;
  /// implicit and imex with cg or sor: relative residual at which it stops. newton, with any
  /// solver: the last correction, in shares of the cloth's extent, which then is already made. In
  /// (0, 1).
  double tolerance = 1e-3;
  /// Over-relaxation of sor, in (0, 2), or, as a solver, 0 for an estimate of the best.
  double omega = 0;
  Preconditioner preconditioner = Preconditioner::automatic;  ///< used by cg
  ImplicitSplit split = ImplicitSplit::by_stability;
  /// imex: share of the springs that shall be explicit, in [0, 1]: it takes as many substeps more
  /// as that asks for.
  double explicit_share = 0;
  EulerRule euler = EulerRule::symplectic;
  BeyondBound beyond_bound = BeyondBound::refuse;
  /// The substep in which the cloth first meets a solid is parted where the nearest vertex is
  /// within this of it [m], not negative; 0: it is not.
  double first_contact = 0;
  NewtonRule rule = NewtonRule::backward_euler;
  Constraints constraints = Constraints::compliant;
  /// multigrid: share of the last substep's acceleration by gravity and constraints in that of this
  /// one, in [0, kMostCarried].
  double carried_acceleration = 0;
  Acceleration acceleration = Acceleration::none;
  int levels = 0;      ///< coarser than the mesh, not negative
  double ratio = 0.5;  ///< share of vertices that a level keeps, in (0.1, 0.9)
  LevelSelection selection = LevelSelection::quadrics;
  LevelLengths level_lengths = LevelLengths::surface;
  Smoother smoother_before = Smoother::none;  ///< smoother of a level on the way to coarser ones
  Smoother smoother_after = Smoother::gauss_seidel;  ///< smoother of a level on the way back
  Attachments attachments = Attachments::none;

  /// Throws ContractError.
  void validate() const;
};

}  // namespace pleat
