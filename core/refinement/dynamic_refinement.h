#pragma once

#include "core/mesh/quad_mesh.h"

namespace pleat {

/// Cloth on a refinement. Hanging vertices lie and move in the middle of their parents.
struct GradedState {
  QuadMesh mesh;
  Positions positions;   ///< [m]
  Positions velocities;  ///< [m/s]
};

struct DynamicOptions {
  double split_curvature = 10;  ///< faces with a corner that bends more are split [1/m], positive
  int max_level = 2;            ///< finest level, 0 to kMaxLevel

  /// Throws InputError naming the value out of range.
  void validate() const;
};

/// Refines and coarsens a mesh to the shape it has, as a frame of an animation goes by: what a
/// plan made in advance is compared with.
///
/// Faces with a corner beyond split_curvature are split. Four siblings whose corners all bend less
/// than half of it are merged, if no face beside them is more than one level finer than their
/// parent. New vertices come into the middle of their parents and move with it. A vertex that goes,
/// or hangs from then on, gives its mass and momentum to its parents, so that linear momentum stays
/// to rounding; the cloth is of one areal density. Splitting keeps it by itself.
///
/// Source: Hutchinson, Preston & Hewitt, Adaptive refinement for mass/spring simulations,
/// Eurographics Workshop on Computer Animation and Simulation, 1996, for the splitting;
/// docs/methods/multiresolution.md.
class DynamicRefinement {
 public:
  /// base  not refined; what every state's mesh is a refinement of
  DynamicRefinement(QuadMesh base, const DynamicOptions& options);

  struct Result {
    GradedState state;
    int n_split = 0;   ///< faces
    int n_merged = 0;  ///< groups of four; with neither, the state stays as it is
  };
  Result adapted(GradedState state) const;

 private:
  QuadMesh base_;
  DynamicOptions options_;
};

}  // namespace pleat
