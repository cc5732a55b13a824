#include "core/modal/completion_curves.h"

#include <algorithm>
#include <cmath>

#include "core/modal/arap_energy.h"

namespace pleat {

std::vector<FrameCurves> completion_curves(const KeyCompletion& completion,
                                           const std::vector<KeyCompletion::Frame>& frames) {
  std::vector<FrameCurves> curves(frames.size(), FrameCurves{0, 0, 0, 0});
  double rest_volume = 0;
  for (std::size_t i = 0; i < completion.bodies().size(); ++i) {
    const ModalBody& body = completion.bodies()[i];
    const TetMesh& rest = body.carrying().volume;
    const ArapEnergy energy(rest, 1);
    rest_volume += total_volume(rest, rest.rest_positions);
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const KeyCompletion::Frame& frame = frames[f];
      const double share = frame.share_of_next;
      const int right = std::min(frame.left + 1, body.n_keys() - 1);
      const Positions shape = body.volume_positions(frame.bodies[i]);
      const Positions straight = (1 - share) * body.volume_positions(body.key(frame.left)) +
                                 share * body.volume_positions(body.key(right));
      curves[f].volume += total_volume(rest, shape);
      curves[f].straight_volume += total_volume(rest, straight);
      curves[f].strain += energy.energy(shape);
      curves[f].straight_strain += energy.energy(straight);
    }
  }
  for (FrameCurves& curve : curves)
    for (double* sum : {&curve.strain, &curve.straight_strain})
      *sum = std::sqrt(*sum / rest_volume);
  return curves;
}

}  // namespace pleat
