#include "core/modal/frame_measures.h"

#include <algorithm>
#include <cmath>

#include "core/modal/arap_energy.h"

namespace pleat {
namespace {

/// places_of(body, frame) tells where the vertices of a body's volume are.
template <class PlacesOf>
std::vector<FrameMeasures> measures(const KeyCompletion& completion, std::size_t n_frames,
                                    const PlacesOf& places_of) {
  double rest_volume = 0;
  std::vector<FrameMeasures> all(n_frames);
  for (std::size_t i = 0; i < completion.bodies().size(); ++i) {
    const TetMesh& rest = completion.bodies()[i].carrying().volume;
    const ArapEnergy energy(rest, 1);
    rest_volume += total_volume(rest, rest.rest_positions);
    for (std::size_t f = 0; f < n_frames; ++f) {
      const Positions places = places_of(i, f);
      all[f].strain += energy.energy(places);
      for (const Tet& tet : rest.tets) {
        const double volume = tet_volume(places, tet);
        all[f].volume += volume;
        all[f].n_inverted += volume <= 0 ? 1 : 0;
      }
    }
  }
  for (FrameMeasures& of : all) of.strain = std::sqrt(of.strain / rest_volume);
  return all;
}

}  // namespace

std::vector<FrameMeasures> frame_measures(const KeyCompletion& completion,
                                          const std::vector<KeyCompletion::Frame>& frames) {
  std::vector<FrameMeasures> all =
      measures(completion, frames.size(), [&](std::size_t body, std::size_t f) {
        return completion.bodies()[body].volume_positions(frames[f].bodies[body]);
      });
  for (std::size_t f = 0; f < frames.size(); ++f)
    all[f].unequal_halves = frames[f].unequal_halves();
  return all;
}

std::vector<FrameMeasures> linear_measures(const KeyCompletion& completion,
                                           const std::vector<KeyCompletion::Frame>& frames) {
  return measures(completion, frames.size(), [&](std::size_t body, std::size_t f) {
    const ModalBody& of = completion.bodies()[body];
    const int next = std::min(frames[f].left + 1, completion.n_keys() - 1);
    const double share = frames[f].share_of_next;
    return Positions((1 - share) * of.volume_positions(of.key(frames[f].left)) +
                     share * of.volume_positions(of.key(next)));
  });
}

}  // namespace pleat
