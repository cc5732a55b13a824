#pragma once

#include <optional>

#include "core/dynamics/implicit/anderson_acceleration.h"
#include "core/dynamics/implicit/contact_hold.h"
#include "core/dynamics/stepper.h"

namespace pleat {

/// Backward Euler by local/global rounds: springs are projected one by one onto their rest length,
/// then one linear system with a factor made beforehand gives the positions. Dampers along springs
/// and springs together are one term, k/2 (l - L)^2 + c/(2h) (l - l_begin)^2, of stiffness k + c/h
/// about the length (k L + c/h l_begin)/(k + c/h). Pinned vertices are eliminated: their places
/// enter the right-hand side, so that a moving pin needs no new factor and does not lag.
///
/// A vertex that a solid holds (ContactHold) is projected too: onto the plane, or the place, where
/// it is held. The matrix then has its resistance once more on the diagonal, whichever way the
/// plane lies, and is factorised anew where other vertices are held than in the substep before.
///
/// Where acceleration is asked for, a round ends where AndersonAcceleration proposes if the energy
/// that the rounds lower is less there than where the round ends by itself.
///
/// Source: Liu, Bargteil, O'Brien & Kavan, Fast simulation of mass-spring systems, SIGGRAPH Asia
/// 2013. Projection onto planes: Bouaziz, Martin, Liu, Kavan & Pauly, Projective dynamics, SIGGRAPH
/// 2014.
class StepperProjective final : public Stepper {
 public:
  /// Throws InputError when the wanted solver is cg (it has no factor to keep) or not available.
  StepperProjective(ClothModel& model, const MethodOptions& options);

  void refresh() override;

  /// How often the acceleration was refused, since this was made.
  int n_refused() const { return acceleration_ ? acceleration_->n_refused() : 0; }

 protected:
  SolveReport substep(State& state, double time_end, double h) override;
  void store(State& state, SolveReport& report) override;

 private:
  /// The part of a spring's term that stays fixed during a substep.
  struct Target {
    double weight = 0;     // k, plus c/h when the damper acts along the spring [N/m]
    double length = 0;     // effective rest length [m]
    Vec3 damped{0, 0, 0};  // c/h (x_a - x_b) at the start, for the isotropic damper [N]
  };
  struct PinnedEntry {
    int free_vertex;
    int pin;
    double value;
  };

  void hold(const State& state, double h);
  void add_air_forces(const State& begin, double h);
  void remember_motion(const State& end, double h);
  void place_first_guess(double time_end, double h);
  void ease_first_guess(double h);
  std::array<double, 2> slopes(double h) const;
  void set_targets(double h);
  /// The right-hand side of the global solve into `side`: M/h^2 y, what pull_of gives for each
  /// spring, and pinned neighbours.
  template <class PullOfSpring>
  void add_up(double time_end, double h, const PullOfSpring& pull_of, VertexRows& side) const;
  void set_right_side(double time_end, double h);
  bool free_pulled(double h);
  double hold_excess(VertexId vertex) const;
  double rounding_of_loads() const;
  void start_acceleration(double time_end, double h);
  void accelerate(double h);
  /// Change of what the rounds lower [J], from positions_ to proposed_, which are `change` apart.
  double energy_change(const LoadedRows& change, double h) const;

  SparseMatrix matrix_;
  Eigen::VectorXd diagonal_;         // the matrix's, but for holds
  std::vector<char> is_free_;        // neither pinned nor hanging, for each vertex
  std::optional<ContactHold> hold_;  // models with contact only
  std::vector<char> is_held_;        // held in the factorised matrix, for each vertex
  std::vector<char> was_held_;
  std::unique_ptr<LinearSolver> solver_;
  SolveReport factor_report_;
  std::vector<PinnedEntry> pinned_entries_;
  std::vector<Target> targets_;
  Positions velocities_begin_;  // start of the substep [m/s]
  Positions velocities_;        // end of a round; models with contact only
  Positions forces_;
  Positions air_forces_;    // drag in the substep; models with air only [N]
  Positions other_forces_;  // all but drag, in the last substep; models with air only [N]
  Positions predicted_;     // x + h v + h^2 M^-1 f_external; 0 where vertices hang
  Positions positions_;
  Positions first_change_;  // way from where neither springs nor solids act to the first round
  Positions fall_;          // way from where cloth coasts to where forces alone lead
  VertexRows right_side_;
  VertexRows solution_;
  Eigen::VectorXd column_;
  std::optional<AndersonAcceleration> acceleration_;
  LoadedRows start_;        // start of the substep's first round
  VertexRows steady_side_;  // part of the right-hand side that no round changes
  Positions proposed_;
  double time_end_ = 0;  // end of the last substep [s]
};

}  // namespace pleat
