#pragma once

#include <algorithm>
#include <vector>

namespace pleat {

/// Puts middles of two neighbours between the frames, two or more in order, where they are farthest
/// apart first, as long as `goes_on`, asked with the number of frames and the widest distance.
template <class Frame, class Distance, class Middle, class GoesOn>
void fill_in(std::vector<Frame>& frames, const Distance& distance, const Middle& middle,
             const GoesOn& goes_on) {
  std::vector<double> gaps;
  for (std::size_t f = 1; f < frames.size(); ++f)
    gaps.push_back(distance(frames[f - 1], frames[f]));
  for (;;) {
    const auto widest = std::max_element(gaps.begin(), gaps.end());
    if (!goes_on(frames.size(), *widest)) return;
    const auto gap = widest - gaps.begin();
    const auto at = static_cast<std::size_t>(gap);
    frames.insert(frames.begin() + gap + 1, middle(frames[at], frames[at + 1]));
    gaps[at] = distance(frames[at], frames[at + 1]);
    gaps.insert(gaps.begin() + gap + 1, distance(frames[at + 1], frames[at + 2]));
  }
}

}  // namespace pleat
