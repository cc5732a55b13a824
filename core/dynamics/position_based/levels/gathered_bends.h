#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/dynamics/position_based/lane_layout.h"

namespace pleat {

/// The bending elements of a model that join no hanging vertex, on any mesh, one after the other:
/// each is one vector constraint, linear in the positions. Vertices as of GatheredSprings.
class GatheredBends {
 public:
  /// h  substep [s]
  GatheredBends(const ClothModel& model, const LaneLayout& layout, double h);

  /// Takes over changed inverse masses, of each slot, see LaneView. Allocates nothing.
  void refresh_pins(const float* inverse_masses);

  /// Projects each element once; `omega` times what a projection alone would correct.
  void sweep(const float* begins, float* moves, float omega);

  /// Makes the multipliers zero.
  void forget() { std::fill(multipliers_.begin(), multipliers_.end(), 0.0f); }
  std::span<float> multipliers() { return multipliers_; }
  std::size_t n_errors() const { return multipliers_.size(); }
  /// (C + compliance/h^2 lambda)/unit of each element, four numbers each; the unit in [m].
  void errors(const float* begins, const float* moves, float unit, float* errors) const;

  /// Sum of |C + compliance/h^2 lambda|^2 [m^2].
  double squared_residual(const float* begins, const float* moves) const;

 private:
  struct Element {
    int before, middle, after;  // first numbers of the slots
    float b_0, b_2;             // weights relative to the middle one
    float compliance;           // mean mass / (stiffness h^2)
    float w_0, w_1, w_2;        // inverse masses times the weights
    float gain;
  };

  std::vector<Element> elements_;
  std::vector<float> multipliers_;  // x, y, z and one unused number each
};

}  // namespace pleat
