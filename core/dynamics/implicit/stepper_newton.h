#pragma once

#include <algorithm>
#include <span>

#include "core/dynamics/implicit/contact_hold.h"
#include "core/dynamics/implicit/pair_hold.h"
#include "core/dynamics/stepper.h"
#include "core/model/system_matrix.h"

namespace pleat {

/// Backward Euler, implicit midpoint or static equilibrium, solved exactly: Newton's method on the
/// potential whose minimum is the end of the substep, with line search, the true Hessian and a
/// direct solver. Where the Hessian proves indefinite, its projected form serves for that
/// iteration. A factor is kept as a preconditioner of conjugate gradients until they take too many
/// iterations.
///
/// With k = h (backward Euler) or h/2 (midpoint: half of a backward step, then extrapolated) and
/// d = x - x_begin it minimises 1/2 d'(M/k^2 + C/k) d - d'(M v/k + f) + E(x). The damping C is
/// taken at the start, for midpoint at x + k v, so that the order stays. Drag enters by its value
/// at each iterate. Equilibrium leaves the first term out and shifts the Hessian by a multiple of M
/// while steps have to be cut (Levenberg-Marquardt).
///
/// Sources: Nocedal & Wright, Numerical optimization, Springer 2006, chapters 3 and 10; Hairer,
/// Lubich & Wanner, Geometric numerical integration, Springer 2006, VI.1;
/// docs/methods/newton.md.
class StepperNewton final : public Stepper {
 public:
  /// Throws InputError when the wanted solver is cg or not available, and for an equilibrium
  /// beside solids or of cloth that nothing holds.
  StepperNewton(ClothModel& model, const MethodOptions& options);

  void refresh() override;

 protected:
  SolveReport substep(State& state, double time_end, double h) override;

 private:
  void set_up(const State& state, double h);
  void hold(const State& state, double h);
  void add_holds(std::span<const ContactHold::Held> holds, double sign);
  void choose_pairs(const State& state, double time_end, double h);
  void add_pairs(std::span<const PairHold::Held> pairs, double sign);
  bool let_loose();
  void place_first_guess(const State& state, double time_end);
  int find_holds();
  SolveReport minimise(double tolerance);
  bool is_stable();
  void push_off(int attempt);
  void evaluate_gradient();
  double potential(const Positions& positions, double* magnitude);
  void fill_matrix(ElementHessian hessian);
  SolveReport solve_with_new_factor();
  SolveReport solve_with_kept_factor();
  SolveReport solve_linear_system();
  SolveReport find_direction();
  bool halves_gradient();
  double search_line();
  /// The squared frequency of a pendulum as long as the cloth: brings it to rest fastest [1/s^2].
  double first_shift() const { return std::max(model_.gravity.norm(), 1.0) / extent_; }
  bool is_at_rest() const { return options().rule == NewtonRule::equilibrium; }

  SystemMatrix matrix_;
  std::optional<ContactHold> hold_;    // backward Euler of models with contact only
  std::optional<PairHold> pair_hold_;  // backward Euler of models with self-contact only
  std::unique_ptr<LinearSolver> solver_;
  SparseMatrix base_;               // M/k^2 + C/k, fixed during a substep [N/m]
  double interval_ = 0;             // k [s]
  double shift_ = 0;                // multiple of M in the Hessian [1/s^2]
  double extent_ = 0;               // diagonal of the box around the cloth [m]
  double first_gradient_norm_ = 0;  // norm where the substep starts [N]
  double rounding_ = 0;             // a gradient below this is noise [N]
  bool is_projected_ = false;       // the matrix at hand
  bool has_factor_ = false;         // factor of some earlier Hessian with the same pins
  double residual_scale_ = 0;       // [N]
  Positions loads_;                 // M v/k + f [N]
  Positions positions_;             // the iterate
  Positions gradient_;              // potential's, there; 0 where pinned [N]
  Positions direction_;
  Positions trial_;
  Positions velocities_;    // (x - x_begin)/k, for drag
  Positions product_;       // base times d [N]
  Positions no_change_;     // pins' changes, all zero
  Eigen::VectorXd change_;  // way since the start [m]
  Eigen::VectorXd right_side_;
  Eigen::VectorXd residual_;  // conjugate gradients', and what they keep beside
  Eigen::VectorXd preconditioned_;
  Eigen::VectorXd search_;
  Eigen::VectorXd image_;
};

}  // namespace pleat
