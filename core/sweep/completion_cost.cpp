#include "core/sweep/completion_cost.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/modal/fill_in.h"
#include "core/modal/full_arap.h"
#include "core/run/part_timer.h"

namespace pleat {

CompletionCost completion_cost(const std::vector<Positions>& keys,
                               const std::vector<Triangle>& triangles, const ModalOptions& options,
                               int n_frames) {
  CompletionCost cost;
  const Stopwatch watch;
  const KeyCompletion completion(keys, triangles, options);
  cost.precompute_ms = 1e3 * watch.elapsed();
  const Stopwatch middles;
  const std::vector<KeyCompletion::Frame> frames = completion.frames(n_frames);
  cost.middles_ms = 1e3 * middles.elapsed();
  const Stopwatch mapping;
  std::vector<Positions> surfaces;
  for (const KeyCompletion::Frame& frame : frames) surfaces.push_back(completion.surface(frame));
  cost.surfaces_ms = 1e3 * mapping.elapsed();
  cost.n_middles = static_cast<int>(frames.size() - keys.size());
  cost.n_bodies = static_cast<int>(completion.bodies().size());
  for (const ModalBody& body : completion.bodies()) {
    cost.n_volume_vertices += body.carrying().volume.n_vertices();
    cost.n_tets += static_cast<int>(body.carrying().volume.tets.size());
  }
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const KeyCompletion::Frame& frame = frames[f];
    if (frame.is_key()) continue;
    for (const ModalBody::Shape& shape : frame.bodies)
      cost.n_unconverged += shape.converged ? 0 : 1;
    const auto left = static_cast<std::size_t>(frame.left);
    cost.middles.push_back(std::move(surfaces[f]));
    cost.linear_middles.emplace_back((1 - frame.share_of_next) * keys[left] +
                                     frame.share_of_next * keys[left + 1]);
  }
  cost.measures = frame_measures(completion, frames);
  cost.linear_measures = linear_measures(completion, frames);
  return cost;
}

UnreducedCost unreduced_cost(const std::vector<Positions>& keys,
                             const std::vector<Triangle>& triangles, const ModalOptions& options,
                             int n_frames) {
  const CarryingVolume carrying = carrying_volume(keys.front(), triangles, options);
  const std::vector<Positions> volumes = key_volumes(carrying, usual_fit(carrying), keys);
  const FullArap arap(carrying.volume);
  const Eigen::VectorXd masses = vertex_volumes(carrying.volume);
  const auto centroid = [&](const Positions& x) -> Vec3 { return x * masses / masses.sum(); };
  const auto about_centroid = [&](const Positions& x) -> Positions {
    return x.colwise() - centroid(x);
  };
  struct Frame {
    Positions x;
    bool is_key;
  };
  std::vector<Frame> frames;
  for (const Positions& volume : volumes) frames.push_back({volume, true});
  const Stopwatch watch;
  fill_in(
      frames,
      [&](const Frame& a, const Frame& b) {
        return std::sqrt((a.x - b.x).cwiseAbs2().colwise().sum().dot(masses));
      },
      [&](const Frame& a, const Frame& b) -> Frame {
        const Positions from = about_centroid(a.x);
        const Positions to = about_centroid(b.x);
        const Positions facing = best_turn(from, to, masses).transpose() * to;
        Positions x = middle_shape(*arap.blend(from, facing), arap.scale()).shape;
        turn_half_way(from, to, masses, x);
        x.colwise() += shift_half_way(a.x, b.x, x);
        return {std::move(x), false};
      },
      [&](std::size_t n, double) { return n < static_cast<std::size_t>(n_frames); });
  UnreducedCost cost;
  cost.middles_ms = 1e3 * watch.elapsed();
  for (const Frame& frame : frames)
    if (!frame.is_key) cost.middles.push_back(carrying.surface(frame.x));
  return cost;
}

double mean_distance_to_nearest(const std::vector<Positions>& frames,
                                const std::vector<Positions>& others) {
  PLEAT_CHECK(!frames.empty() && !others.empty(), "frames, and others to compare with");
  double sum = 0;
  for (const Positions& frame : frames) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Positions& other : others)
      nearest = std::min(nearest, (frame - other).squaredNorm());
    sum += std::sqrt(nearest / static_cast<double>(frame.cols()));
  }
  return sum / static_cast<double>(frames.size());
}

}  // namespace pleat
