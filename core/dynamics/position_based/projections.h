#pragma once

#include <string>

#include "core/dynamics/method_options.h"
#include "core/dynamics/position_based/lane_layout.h"
#include "core/dynamics/position_based/lane_operations.h"
#include "core/dynamics/position_based/spring_law.h"
#include "core/model/cloth_model.h"

namespace pleat {

/// The constraints of a position-based substep, and the way in which they are solved.
class Projections {
 public:
  virtual ~Projections() = default;

  /// Takes over pins that changed in number or vertex; inverse masses of each slot, see LaneView.
  virtual void refresh_pins(const ClothModel& model, const float* inverse_masses) = 0;
  /// Takes over changed rest lengths. Allocates nothing.
  virtual void refresh_rest_lengths(const ClothModel& model) = 0;

  /// Moves vertices that may move until the constraints hold better, in so many rounds. The first
  /// one starts from multipliers of zero. Allocates nothing after the first call.
  virtual void solve(const LaneView& view, int rounds) = 0;

  /// Sweeps of the finest mesh that a round costs: those of coarser levels count by their share of
  /// constraints.
  virtual double sweeps_per_round() const = 0;

  /// Makes the multipliers zero, and keeps those of the next solve.
  virtual void forget() = 0;
  /// Sum of |C + compliance/h^2 lambda|^2 over the constraints of the finest mesh [m^2], with the
  /// multipliers that forget() made or the solve after it.
  virtual double squared_residual(const LaneView& view) = 0;

  /// Names what the options ask for and this cloth has not, in a sentence's middle; empty for
  /// nothing.
  virtual std::string remark() const { return {}; }
};

}  // namespace pleat
