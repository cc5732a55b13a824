#include "core/dynamics/position_based/lanes/group_freedom.h"

#include <algorithm>
#include <limits>

namespace pleat {

void GroupFreedom::restart(int n_groups, int n_solids) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  n_padded_ = (n_solids + Float4::kLanes - 1) / Float4::kLanes * Float4::kLanes;
  shifts_.assign(static_cast<std::size_t>(n_padded_), 0.0f);
  free_.assign(static_cast<std::size_t>(n_groups) * static_cast<std::size_t>(n_padded_), kInfinity);
  for (int group = 0; group < n_groups; ++group) std::fill_n(of(group), n_solids, -kInfinity);
}

void GroupFreedom::begin_substep(std::span<const float> shifts, float stretch) {
  std::copy(shifts.begin(), shifts.end(), shifts_.begin());
  stretch_ = stretch;
}

}  // namespace pleat
