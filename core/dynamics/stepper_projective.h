#pragma once

#include "core/dynamics/stepper.h"

namespace pleat {

/// Backward Euler by local/global rounds: springs are projected one by one onto their rest length,
/// then one linear system with a factor made beforehand gives the positions. Dampers along springs
/// and springs together are one term, k/2 (l - L)^2 + c/(2h) (l - l_begin)^2, of stiffness k + c/h
/// about the length (k L + c/h l_begin)/(k + c/h). Pinned vertices are eliminated: their places
/// enter the right-hand side, so that a moving pin needs no new factor and does not lag.
///
/// Source: Liu, Bargteil, O'Brien & Kavan, Fast simulation of mass-spring systems, SIGGRAPH Asia
/// 2013.
class StepperProjective final : public Stepper {
 public:
  /// Throws InputError when the wanted solver is cg (it has no factor to keep) or not available.
  StepperProjective(ClothModel& model, const MethodOptions& options);

  void refresh() override;

 protected:
  SolveReport substep(State& state, double time_end, double h) override;
  void store(State& state, SolveReport& report) override;

 private:
  using VertexRows =
      Eigen::Matrix<double, Eigen::Dynamic, 3>;  // one row per vertex: three right-hand sides

  /// The part of a spring's term that stays fixed during a substep.
  struct Target {
    double weight = 0;     // k, plus c/h when the damper acts along the spring [N/m]
    double length = 0;     // effective rest length [m]
    Vec3 damped{0, 0, 0};  // c/h (x_a - x_b) at the begin, for the isotropic damper [N]
  };
  struct PinnedEntry {
    int free_vertex;
    int pin;
    double value;
  };

  void set_targets(double h);
  void set_right_side(double time_end, double h);

  SparseMatrix matrix_;
  std::unique_ptr<LinearSolver> solver_;
  SolveReport factor_report_;
  std::vector<PinnedEntry> pinned_entries_;
  std::vector<Target> targets_;
  Positions forces_;
  Positions predicted_;  // x + h v + h^2 M^-1 f_external; 0 where vertices hang
  Positions positions_;
  Positions first_change_;  // what the first round of a substep moved
  VertexRows right_side_;
  VertexRows solution_;
  Eigen::VectorXd column_;
  Positions positions_begin_;
  double time_end_ = 0;  // of the last substep [s]
};

}  // namespace pleat
