#pragma once

#include <algorithm>
#include <vector>

#include "core/dynamics/position_based/lanes/spring_order.h"
#include "core/dynamics/position_based/spring_law.h"

namespace pleat {

/// The springs of a model that join no hanging vertex, compiled into operations on four of them at
/// a time and into an order. Springs that follow on one another across the rows are solved a line
/// at a time; then the others are projected one after the other.
class SpringProgram {
 public:
  /// h  substep [s]
  SpringProgram(const ClothModel& model, const LaneLayout& layout, SpringLaw law, double h);

  /// Takes over changed rest lengths. Allocates nothing.
  void refresh_rest_lengths(const ClothModel& model) { fill_blocks(model); }

  /// Projects each spring once; the first sweep of a substep starts from multipliers of zero.
  void sweep(const LaneView& view, bool is_first);
  /// Makes the multipliers zero.
  void forget() { std::fill(multipliers_.begin(), multipliers_.end(), 0.0f); }

  /// Sum of (C + compliance/h^2 lambda)^2 [m^2].
  double squared_residual(const LaneView& view) const;

  /// Works on the lanes of what is in no line one after the other: same result, to hold the two
  /// against each other.
  void compute_lane_by_lane() {
    for (OperationStretch& stretch : stretches_) stretch.whole = false;
  }

  std::size_t n_operations() const { return operations_.size(); }
  std::size_t n_blocks() const { return blocks_.size(); }

 private:
  using Block = SpringBlock;
  /// The first slots of the groups of both ends, and the index of the numbers.
  struct Operation {
    int a, b;
    int block;
  };

  Block block_of(const ClothModel& model, const LaneMembers& members) const;
  void fill_blocks(const ClothModel& model);

  template <SpringLaw law, bool first>
  void sweep(const LaneView& view);
  template <SpringLaw law, bool first>
  void solve_line(const LaneView& view, const SpringLine& line);
  template <SpringLaw law, bool first>
  Float4 eliminate(const LaneView& view, const SpringLine& line);
  template <SpringLaw law, bool first>
  void substitute(const LaneView& view, const SpringLine& line, Float4 largest_pull);
  float* line_scratch(int row, int channel);
  template <SpringLaw law, bool first>
  void project(const LaneView& view);

  SpringLaw law_;
  double h_;          // [s]
  double mean_mass_;  // [kg]
  std::vector<Operation> operations_;
  std::vector<LaneMembers> members_;
  std::vector<Block> blocks_;                // equal ones are shared
  std::vector<SpringLine> lines_;            // made of the first operations
  std::vector<OperationStretch> stretches_;  // the other operations
  std::vector<float> multipliers_;           // a group per operation
  std::vector<float> line_scratch_;          // see solve_line
};

}  // namespace pleat
