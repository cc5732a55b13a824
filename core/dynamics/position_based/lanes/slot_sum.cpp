#include "core/dynamics/position_based/lanes/slot_sum.h"

namespace pleat {

SlotSum sum_in_slots(const Combination& sum, const LaneLayout& layout) {
  SlotSum in_slots;
  for (std::size_t t = 0; t < sum.n_terms; ++t) {
    in_slots.slots[t] = layout.places[static_cast<std::size_t>(sum.terms[t].vertex)].slot;
    in_slots.factors[t] = static_cast<float>(sum.terms[t].factor);
  }
  in_slots.n_terms = sum.n_terms;
  return in_slots;
}

Float1 inverse_mass_of(const SlotSum& sum, const float* inverse_masses) {
  float total = 0;
  for (std::size_t t = 0; t < sum.n_terms; ++t)
    total += sum.factors[t] * sum.factors[t] * inverse_masses[sum.slots[t]];
  return {total};
}

void move_by(const SlotSum& sum, const Vec3Lanes<Float1>& pull, const float* inverse_masses,
             const std::array<float*, 3>& arrays) {
  for (std::size_t t = 0; t < sum.n_terms; ++t) {
    const int slot = sum.slots[t];
    const Float1 share{sum.factors[t] * inverse_masses[slot]};
    store(load<Float1>(arrays, slot) + share * pull, arrays, slot);
  }
}

}  // namespace pleat
