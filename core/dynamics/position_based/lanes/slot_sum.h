#pragma once

#include <array>
#include <cstddef>

#include "core/dynamics/position_based/lane_layout.h"
#include "core/dynamics/position_based/lane_operations.h"
#include "core/model/hanging_vertices.h"

namespace pleat {

/// Factors times the places at slots. The factors sum to zero.
struct SlotSum {
  std::array<int, 6> slots{};
  std::array<float, 6> factors{};
  std::size_t n_terms = 0;
};

/// The sum of places of vertices, in their slots.
SlotSum sum_in_slots(const Combination& sum, const LaneLayout& layout);

/// How far the sum moves per pull.
Float1 inverse_mass_of(const SlotSum& sum, const float* inverse_masses);

/// Moves each place of `arrays` by its share of the pull.
void move_by(const SlotSum& sum, const Vec3Lanes<Float1>& pull, const float* inverse_masses,
             const std::array<float*, 3>& arrays);

/// The sum, in differences from the first place: those of numbers near each other are not rounded.
template <class Pointer>
Vec3Lanes<Float1> value(const SlotSum& sum, const std::array<Pointer, 3>& arrays) {
  const Vec3Lanes<Float1> first = load<Float1>(arrays, sum.slots[0]);
  Vec3Lanes<Float1> total{{0}, {0}, {0}};
  for (std::size_t t = 1; t < sum.n_terms; ++t)
    total = total + Float1{sum.factors[t]} * (load<Float1>(arrays, sum.slots[t]) - first);
  return total;
}

}  // namespace pleat
