#pragma once

#include <memory>
#include <vector>

#include "core/dynamics/position_based/projections.h"
#include "core/model/cloth_model.h"
#include "core/model/state.h"

namespace pleat {

/// Places where a position-based step starts, and where it would end without constraints [m].
struct PredictedStep {
  double h = 0;         ///< [s]
  Positions begins;     ///< x
  Positions predicted;  ///< x + h v + h^2 g; what is pinned is at its pins' end
};

/// The step of h [s] that ends at time_end, without air and solids. Hanging vertices are in the
/// middle of their parents.
PredictedStep predicted_step(const ClothModel& model, State state, double time_end, double h);

/// The solve of one position-based step taken by itself, as often as wanted and always from the
/// same predicted places: what so many rounds leave of its error.
class StepSolve {
 public:
  /// options  with a position-based stepper; their step and substeps do not matter
  /// Keeps nothing of its arguments.
  StepSolve(const ClothModel& model, const MethodOptions& options, const PredictedStep& step);

  /// Projects from the predicted places and multipliers of zero; no round leaves them there.
  /// Allocates nothing after the first call.
  void solve(int rounds);

  /// |C + compliance/h^2 lambda| over all constraints of the finest mesh after the last solve, over
  /// its value at the predicted places with multipliers of zero. 0 where that is 0.
  double relative_error();
  /// Places after the last solve [m]. Hanging vertices are in the middle of their parents.
  Positions positions() const;
  /// See Projections.
  double sweeps_per_round() const { return projections_->sweeps_per_round(); }

 private:
  enum Array { begin, move = 3, inverse_mass = 6, kArrays };

  float* array(int which) { return data_.data() + static_cast<std::size_t>(which) * pitch_; }
  LaneView view();

  LaneLayout layout_;
  std::vector<HangingVertex> hanging_;
  std::unique_ptr<Projections> projections_;
  std::size_t pitch_;               // floats from one array to the next
  std::vector<float> data_;         // see Array
  std::vector<float> first_moves_;  // moves to the predicted places
  Vec3 origin_;                     // origin of the places [m]
  double residual_begin_ = 0;       // [m]
};

}  // namespace pleat
