#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/dynamics/position_based/lane_layout.h"
#include "core/dynamics/position_based/lanes/bend_sets.h"

namespace pleat {

/// Says what a sweep makes of multipliers.
enum class Multipliers {
  passing,  ///< zero at first, and not kept
  begun,    ///< zero at first
  kept,
};

/// The bending elements of a model that join no hanging vertex: each is one vector constraint,
/// linear in the positions. Those of a thread are solved at once, four threads at a time. Which
/// elements are which threads' does not depend on the layout, nor need threads be a grid.
///
/// Source: docs/methods/xpbd.md, "Bending".
class BendProgram {
 public:
  /// h  substep [s]
  BendProgram(const ClothModel& model, const LaneLayout& layout, double h);

  /// Takes over inverse masses of each slot, see LaneView. To be called before the first sweep.
  void refresh_pins(const float* inverse_masses);

  /// Solves each thread once. A substep's first sweep is no `kept` one.
  void sweep(const LaneView& view, Multipliers multipliers);
  /// Makes the multipliers zero.
  void forget() { std::fill(multipliers_.begin(), multipliers_.end(), 0.0f); }
  std::span<float> multipliers() { return multipliers_; }

  std::size_t n_errors() const { return multipliers_.size(); }
  /// (C + compliance/h^2 lambda)/unit of each element and component; the unit in [m].
  void errors(const LaneView& view, float unit, float* errors) const;
  /// Sum of |C + compliance/h^2 lambda|^2 [m^2].
  double squared_residual(const LaneView& view) const;

  /// Works on the lanes one after the other: same result, to hold the two against each other.
  void compute_lane_by_lane() { is_lane_by_lane_ = true; }

  bool empty() const { return sets_.sets.empty(); }
  std::size_t n_sets() const { return sets_.sets.size(); }

 private:
  /// A place of four threads: numbers of the element that begins there, then the inverse masses of
  /// the vertices. 0 where a thread has no such element or vertex.
  struct Place {
    PerLane<float> before{}, middle{}, after{};  // weights, the middle one with opposite sign
    PerLane<float> compliance{};
    PerLane<float> next_but_one{}, next{}, inverse_pivot{};  // see BendChainFactor
    PerLane<float> inverse_mass{};
    bool operator==(const Place&) const = default;
  };
  const Place* places_of(const BendSet& set) const { return places_.data() + set.first_place; }
  std::vector<Place> make_places(const BendSet& set, const float* inverse_masses) const;

  template <Multipliers use>
  void sweep(const LaneView& view);
  template <class Lanes, Multipliers use, bool in_groups>
  void solve(const LaneView& view, const BendSet& set, int lane);
  template <Multipliers use>
  void solve_groups(const LaneView& view, const BendSet* sets, int n_sets);
  template <Multipliers use>
  void solve_rows(const LaneView& view, const BendSet& set);
  template <class Lanes, Multipliers use, class EdgeTo>
  void eliminate(const BendSet& set, int lane, float* scratch, const EdgeTo& edge_to);
  template <class Lanes, Multipliers use, class MoveBy>
  void substitute(const BendSet& set, int lane, const float* scratch, const MoveBy& move_by);
  template <class Visit>
  void visit_errors(const LaneView& view, const Visit& visit) const;

  bool is_lane_by_lane_ = false;
  std::vector<BendChain> chains_;
  BendSets sets_;
  std::vector<Place> places_;       // set by set; equal ones share theirs
  std::vector<float> multipliers_;  // x, y, z groups per place with an element
  std::vector<float> scratch_;      // three groups per place, of four sets
};

}  // namespace pleat
