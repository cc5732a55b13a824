#pragma once

#include <array>
#include <vector>

#include "core/dynamics/cloth_model.h"
#include "core/dynamics/lane_layout.h"

namespace pleat {

/// The vertices in lane order, as projections see them: each is at begins + moves. A move is small
/// against a position, so that what a projection adds to it is not rounded to the position's last
/// bit.
struct LaneView {
  std::array<float*, 3> moves;         ///< x, y, z since the substep's begin [m]
  std::array<const float*, 3> begins;  ///< places at the substep's begin, to single precision [m]
  const float* inverse_masses;         ///< mean mass / mass; 0 where pinned and in padding
};

/// How a spring pulls.
enum class SpringLaw {
  rigid,             ///< keeps its rest length whatever the force
  elastic,           ///< stiffness only
  damped,            ///< stiffness, and damping along the spring
  damped_isotropic,  ///< stiffness, and damping of every relative velocity
};

/// All springs and bending elements of a model, compiled into operations on four of them at a time
/// and into an order. Sweeping applies each constraint once, Gauss-Seidel: each sees what those
/// before it did.
class ConstraintProgram {
 public:
  /// h  substep [s]
  ConstraintProgram(const ClothModel& model, const LaneLayout& layout, bool rigid, double h);

  /// Takes over changed rest lengths. Allocates nothing.
  void refresh_rest_lengths(const ClothModel& model);

  /// One sweep of a substep. The first one starts from multipliers of zero.
  void first_sweep(const LaneView& view);
  void next_sweep(const LaneView& view);

  /// Norm of C + compliance/h^2 lambda over all constraints [m], with the multipliers of the last
  /// sweep, or with none.
  double residual(const LaneView& view) const;
  double residual_before_sweeps(const LaneView& view) const;

  /// Works on the lanes one after the other. Same result; to hold the two against each other.
  void compute_lane_by_lane();

  double mean_mass() const { return mean_mass_; }  ///< [kg]
  std::size_t n_operations() const { return springs_.size() + bends_.size(); }
  std::size_t n_spring_blocks() const { return spring_blocks_.size(); }

 private:
  static constexpr int kLanes = 4;
  using Members = std::array<int, kLanes>;  // index of the element in each lane, or -1
  template <class Value>
  using Lane = std::array<Value, kLanes>;

  /// The first slots of the two ends, and the numbers.
  struct SpringOperation {
    int a, b;
    int block;
  };
  struct SpringBlock {
    Lane<float> rest;               // L, or L^2/2 for the rigid law [m or m^2]
    Lane<float> compliance;         // mean mass / (stiffness h^2); 0 in empty lanes
    Lane<float> denominator_share;  // the same, but infinite in empty lanes: nothing moves there
    Lane<float> damper_share;       // of the stiffness k + c/h, what is c/h
    Lane<float> damper_compliance;  // of the isotropic damper; infinite in empty lanes
    bool operator==(const SpringBlock&) const = default;
  };
  struct BendOperation {
    int before, middle, after;
  };
  struct BendBlock {
    Lane<float> before, after;  // weights relative to the middle one
    Lane<float> compliance, denominator_share;
  };
  /// Operations that follow on one another and are computed alike.
  struct Stretch {
    int begin, end;
    bool whole;  // false where the lanes of one operation could touch each other's places
  };

  void compile_springs(const ClothModel& model, const LaneLayout& layout);
  void compile_bends(const ClothModel& model, const LaneLayout& layout);
  void fill_spring_blocks(const ClothModel& model);
  SpringBlock spring_block(const ClothModel& model, const Members& members) const;

  template <SpringLaw law, bool first>
  void sweep_springs(const LaneView& view);
  template <bool first>
  void sweep_bends(const LaneView& view);
  template <bool first>
  void sweep(const LaneView& view);
  double residual(const LaneView& view, bool with_multipliers) const;

  SpringLaw law_;
  double h_;          // [s]
  double mean_mass_;  // [kg]
  std::vector<SpringOperation> springs_;
  std::vector<Members> spring_members_;
  std::vector<SpringBlock> spring_blocks_;  // equal ones are shared
  std::vector<Stretch> spring_stretches_;
  std::vector<float> spring_multipliers_;  // per operation: 4, or 16 with the isotropic damper
  std::vector<BendOperation> bends_;
  std::vector<Members> bend_members_;
  std::vector<BendBlock> bend_blocks_;  // one per operation
  std::vector<Stretch> bend_stretches_;
  std::vector<float> bend_multipliers_;  // 12 per operation
};

}  // namespace pleat
