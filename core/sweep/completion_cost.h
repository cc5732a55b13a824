#pragma once

#include "core/modal/frame_measures.h"

namespace pleat {

/// Cost and quality of frames between keys.
struct CompletionCost {
  int n_bodies = 0;
  int n_volume_vertices = 0;
  int n_tets = 0;
  int n_middles = 0;
  double precompute_ms = 0;  ///< volumes, modes, space and clusters, of all keys
  double middles_ms = 0;     ///< all middles, in the space
  double surfaces_ms = 0;    ///< all frames' surfaces, with detail
  int n_unconverged = 0;
  std::vector<FrameMeasures> measures;         ///< measures of the frames, keys among them
  std::vector<FrameMeasures> linear_measures;  ///< measures of frames on straight ways, then
  std::vector<Positions> middles;              ///< surfaces of the frames between keys [m]
  std::vector<Positions> linear_middles;       ///< [m]
};

CompletionCost completion_cost(const std::vector<Positions>& keys,
                               const std::vector<Triangle>& triangles, const ModalOptions& options,
                               int n_frames);

/// Cost without a space: every vertex of the volumes is free and every tetrahedron turns for
/// itself.
struct UnreducedCost {
  double middles_ms = 0;
  std::vector<Positions> middles;  ///< surfaces of the frames between keys, without detail [m]
};

/// keys  surfaces in one part
UnreducedCost unreduced_cost(const std::vector<Positions>& keys,
                             const std::vector<Triangle>& triangles, const ModalOptions& options,
                             int n_frames);

/// The mean over frames of the root mean square distance of their vertices from those of the
/// nearest of other frames [m].
double mean_distance_to_nearest(const std::vector<Positions>& frames,
                                const std::vector<Positions>& others);

}  // namespace pleat
