#pragma once

#include <memory>
#include <vector>

#include "core/base/part_observer.h"
#include "core/deform/deform_energy.h"
#include "core/linalg/lbfgs.h"
#include "core/linalg/linear_solver.h"

namespace pleat {

/// One step towards the least energy.
struct DeformStep {
  double energy = 0;         ///< weighted energy after the step
  DeformTerms terms;         ///< unweighted terms after the step
  double relative_step = 0;  ///< RMS change of the free vertices over cloth_extent
  int halvings = 0;          ///< halvings of the step until the energy fell
  bool linearised = false;   ///< a metric and its factor were made for it
  double damping = 0;        ///< Levenberg's, over the mean of the metric's diagonal
};

/// When a step may make a new metric and factor.
enum class Linearise {
  when_needed,  ///< a new metric and factor as soon as those at hand serve badly
  never,        ///< only where there is none at all
};

/// A shape, and the steps that led to it.
struct DeformShape {
  Positions positions;  ///< [m]
  std::vector<DeformStep> steps;
  bool converged = false;
};

/// The shape of least deformation energy of a mesh, some of whose vertices are held.
///
/// Steps of L-BFGS whose first metric is a sparse Cholesky factor of DeformEnergy::metric, kept
/// while it serves. A step is halved until the energy falls; if that does not help, a new factor is
/// made, and then a damped one. So the energy never rises while nothing is moved.
///
/// The same calls give the same bits. Source: Nocedal & Wright, Numerical optimization, 2nd ed.,
/// Springer 2006, section 7.2; docs/methods/deformation.md.
class DeformSolver {
 public:
  static constexpr double kTolerance = 1e-6;  ///< tolerance of DeformStep::relative_step
  static constexpr int kMaxLinearisations = 15;

  /// Starts at rest with nothing held. Throws ContractError as DeformEnergy does, and for weights
  /// that are negative or all zero.
  DeformSolver(const TriangleMesh& mesh, EnergyForm form, const DeformWeights& weights);
  DeformSolver(DeformSolver&&) = default;
  ~DeformSolver();

  /// Keeps the shape, and with equal weights all else too.
  void set_weights(const DeformWeights& weights);

  /// Holds these vertices, each once, and no others. They stay where they are until moved.
  void hold(std::vector<VertexId> vertices);

  /// Moves what is held, one column per held vertex in their order [m]. The rest follows as far as
  /// the factor at hand foresees.
  void move_held(const PositionsView& places);

  /// A hand's move, bounded in time: move_held and a few steps, one of which may linearise.
  SolveReport follow(const PositionsView& places);

  /// Goes back to rest, bent by a thousandth of its size, the same way each time, as a flat shape
  /// can be a saddle; from there what is held moves to these places. Where that turns it by more
  /// than 30 degrees on the whole, rest turned along with it is the other start, and the one of
  /// lower energy is taken.
  void restart(const PositionsView& places);
  /// Goes back to rest and moves what is held to its present places.
  void restart() { restart(held_places()); }

  /// One step; nothing once converged. Not ok when the energy could not be made smaller.
  SolveReport step(Linearise allowed = Linearise::when_needed);

  /// One step of `solve`: not ok when there is no use in more.
  SolveReport step_towards_end(int max_linearisations = kMaxLinearisations);

  /// Steps until converged. Having linearised so many times, it goes on while the last factor
  /// serves and then reports not_converged. The report's iterations are linearisations, with the
  /// one that a move may have needed.
  SolveReport solve(int max_linearisations = kMaxLinearisations);

  /// Solves from here and from `restart`, and keeps the shape of lower energy with its steps: where
  /// recovery hardly counts, the way that a hand took can end in another minimum. The report's
  /// iterations are those of both.
  SolveReport settle(int max_linearisations = kMaxLinearisations);

  DeformShape shape() const { return {positions_, steps_, converged_}; }
  /// Goes back to a shape that it had while the same was held at the same places.
  void take_back(DeformShape shape);

  /// The last step was not longer than the tolerance and hardly gained, or rounding hides what is
  /// left to gain.
  bool converged() const { return converged_; }
  /// Linearisations made so far, for steps and for moves.
  int n_linearisations() const { return n_linearisations_; }
  /// Linearisations since something was last moved, held or weighted otherwise.
  int n_recent_linearisations() const { return n_linearisations_ - n_before_; }
  /// Steps since then.
  const std::vector<DeformStep>& steps() const { return steps_; }
  const Positions& positions() const { return positions_; }
  const std::vector<VertexId>& held() const { return held_; }
  const DeformWeights& weights() const { return weights_; }
  const DeformEnergy& model() const { return energy_; }
  DeformTerms terms() const { return energy_.terms(positions_); }
  double energy() const { return terms().weighted(weights_); }

  void observe(PartObserver* observer) { observer_ = observer; }

 private:
  static constexpr std::size_t kMaxCorrections = 20;

  void begin_anew();
  bool dampen();
  SolveReport linearise();
  Positions held_places() const;
  Positions free_gradient() const;
  Positions foreseen(const Positions& moves);
  void take_if_lower(Positions shape);
  void remember(const Positions& gradient) {
    if (last_change_.cols() > 0) corrections_.remember(last_change_, gradient - last_gradient_);
  }
  Positions descent(const Positions& gradient);
  bool descend(const Positions& direction, double slope, double before, DeformStep& step);
  void judge(const DeformStep& step, double before);

  DeformEnergy energy_;
  DeformWeights weights_;
  double extent_;     // extent of the cloth at rest [m]
  Positions bulges_;  // bends that `restart` adds to rest [m]
  Positions positions_;
  std::vector<VertexId> held_;
  std::vector<char> is_held_;  // flag of each vertex

  SparseMatrix metric_;                   // lower triangle, n x n
  std::unique_ptr<LinearSolver> solver_;  // the metric's, with identity rows for what is held
  bool has_pattern_ = false;
  bool has_factor_ = false;
  bool is_stale_ = false;         // the factor serves badly
  int n_with_factor_ = 0;         // steps since the last move
  double first_with_factor_ = 0;  // DeformStep::relative_step of the first
  int n_in_vain_ = 0;             // factors in a row whose first step was halved much
  int n_linearisations_ = 0;
  int n_before_ = 0;  // linearisations before something was last moved, held or weighted
  double damping_ = 0;
  LbfgsCorrections corrections_{kMaxCorrections};  // corrections to the factor
  Positions last_change_;                          // empty where there is no step to learn from
  Positions last_gradient_;

  std::vector<DeformStep> steps_;
  bool converged_ = false;
  PartObserver* observer_ = nullptr;
};

}  // namespace pleat
