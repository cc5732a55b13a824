#pragma once

#include <vector>

#include "core/dynamics/position_based/lane_layout.h"
#include "core/dynamics/position_based/lane_operations.h"
#include "core/model/cloth_model.h"

namespace pleat {

/// Keeps the angular momentum of a substep about the axes that pins leave free: all of them for
/// cloth that nothing or one point holds, the line of pins that are in one if it is steep. Pulls of
/// a solve that is not finished have a couple, and about such an axis nothing takes it up.
///
/// Cloth in several pieces, or with a pin that moves, is left as it is. Source:
/// docs/methods/xpbd.md, "Free turns".
class FreeTurns {
 public:
  explicit FreeTurns(const LaneLayout& layout) : layout_(layout) {}

  /// Takes over pins; inverse masses of each slot, see LaneView.
  void refresh(const ClothModel& model, const float* inverse_masses);

  /// True where pins leave no axis.
  bool empty() const { return axes_ == Axes::none; }

  /// Moves of a substep as they are without constraints, by slot, to be filled in before each
  /// solve [m].
  std::array<float*, 3> unconstrained();

  /// Takes out of the moves the torque that they have beyond the unconstrained ones, by one rigid
  /// turn. Momentum stays.
  ///
  /// origin  of the lanes' places [m]
  void keep(const LaneView& view, const Vec3& origin) const;

 private:
  enum class Axes { none, one, all };

  struct Sums {
    Vec3 torque;    // sum of m b x d about the centre [kg m^2], masses relative to the mean one
    Vec3 moment;    // sum of m b
    Mat3 products;  // sum of m b b^T
  };

  Sums sums(const LaneView& view, const Vec3& centre) const;
  Vec3 turn_against(const Sums& sums) const;

  const LaneLayout& layout_;
  Axes axes_ = Axes::none;
  bool is_held_ = false;
  Vec3 point_{0, 0, 0};  // any on the axes, where something is held [m]
  Vec3 axis_{0, 0, 0};   // direction of the only one
  double mass_ = 0;      // all that moves, over the mean mass of a vertex
  std::vector<float>
      masses_;  // each slot's over the mean one; 0 where pinned, hanging, and in padding
  std::vector<float> unconstrained_;
};

}  // namespace pleat
