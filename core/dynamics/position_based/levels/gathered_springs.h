#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/dynamics/position_based/lane_layout.h"
#include "core/dynamics/position_based/levels/length_groups.h"
#include "core/dynamics/position_based/levels/strain_rows.h"
#include "core/dynamics/position_based/spring_law.h"

namespace pleat {

/// The springs of a model that join no hanging vertex, on any mesh: four at a time in an order in
/// which no two of four share a vertex. Every vertex is four numbers, x y z and one unused, by its
/// slot, at its start and its move of the substep.
class GatheredSprings {
 public:
  /// h  substep [s]
  GatheredSprings(const ClothModel& model, const LaneLayout& layout, SpringLaw law, double h);

  /// Take over changed inverse masses, of each slot (see LaneView), and rest lengths. Allocate
  /// nothing.
  void refresh_pins(const float* inverse_masses);
  void refresh_rest_lengths(const ClothModel& model);

  /// Projects each spring once.
  void sweep(const float* begins, float* moves, const Relaxation& relaxation);

  /// Makes the multipliers zero.
  void forget() { std::fill(multipliers_.begin(), multipliers_.end(), 0.0f); }
  /// None of rigid springs.
  std::span<float> multipliers();
  /// (C + compliance/h^2 lambda)/L of each spring, four a group; 0 where a group has none.
  void strains(const float* begins, const float* moves, float* strains) const;
  std::size_t n_strains() const { return 4 * groups_.size(); }
  /// The springs that this projects, and where their strains stand.
  StrainedEdges strained_edges(const ClothModel& model) const;

  /// Sum of (C + compliance/h^2 lambda)^2 [m^2].
  double squared_residual(const float* begins, const float* moves) const;

 private:
  struct Group {
    std::array<int, 4> a, b;  // first numbers of the slots
    LaneMembers members;
    std::array<float, 4> w_a, w_b;
    SpringBlock block;
  };

  template <SpringLaw law>
  void project(const float* begins, const float* moves, float* to, float omega);

  SpringLaw law_;
  double h_;          // [s]
  double mean_mass_;  // [kg]
  std::vector<Group> groups_;
  std::vector<float> multipliers_;
  MeanCorrection<Float4> mean_;
};

}  // namespace pleat
