#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "core/dynamics/method_options.h"
#include "core/scene/scene.h"

namespace pleat {

/// Diagonals of quads that are springs. Rigid springs on both contradict each other: four corners
/// with six lengths stay flat, and the error ends at a plateau.
enum class Diagonals {
  one,  ///< sides of the surface's triangles, each as stiff as two
  both,
};

struct ConvergenceOptions {
  std::vector<MethodOptions> methods;
  Constraints constraints = Constraints::rigid;  ///< kind of constraints for position-based methods
  Diagonals diagonals = Diagonals::one;
  double time = 0;         ///< the step begins at the step of the scene nearest to it [s]
  int most_rounds = 1025;  ///< limit for each method
  /// A method that took longer for a solve is not given more rounds [s].
  double longest_solve = std::numeric_limits<double>::infinity();
  /// Relative errors whose rounds are found, in (0, 1).
  std::vector<double> targets = {1e-1, 1e-2, 1e-3, 1e-4};
  int repeat = 1;  ///< timed batches of each number of rounds, methods in turn
  std::function<void(double)> on_progress;  ///< told how much of the study is done, 0 to 1
};

/// Measures of a step after so many rounds of a method.
struct ConvergencePoint {
  int rounds = 0;
  double sweeps = std::numeric_limits<double>::quiet_NaN();  ///< sweeps of the finest mesh
  double ms = 0;                                             ///< median of the batches
  /// See StepSolve::relative_error; NaN of other than position-based methods.
  double relative_error = std::numeric_limits<double>::quiet_NaN();
  /// RMS distance to what the method's own equations come to, over that of the predicted places;
  /// NaN of rigid constraints (converged_step).
  double relative_distance = std::numeric_limits<double>::quiet_NaN();
};

struct ConvergenceSeries {
  MethodOptions method;
  std::vector<ConvergencePoint> points;  ///< points ordered by rounds
  double distance_begin = 0;    ///< RMS, of the predicted places from the converged ones [m]
  double distance_unknown = 0;  ///< how far those may be off [m]; NaN where none were found
};

struct ConvergenceStudy {
  double time = 0;  ///< when the step begins [s]
  double step = 0;  ///< [s]
  int n_vertices = 0, n_springs = 0, n_bends = 0;
  std::vector<ConvergenceSeries> series;  ///< results in the order of the methods
};

/// One step of a scene, solved by each method from the same predicted places, without air and
/// solids. Until then the scene runs with its own method.
///
/// Position-based methods are measured after 1, 2, 3, 5, 9, ... rounds and at the first that
/// reaches each target. Others take one substep, with as many iterations where they read them.
/// Milliseconds are of solves from the start, again and again for 50 ms and more.
///
/// Throws InputError where the cloth has no surface or is not of springs, where vertices hang,
/// and for a run that ends before its time.
ConvergenceStudy study_convergence(const Scene& scene, const ConvergenceOptions& options);

}  // namespace pleat
