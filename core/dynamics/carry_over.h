#pragma once

#include <vector>

#include "core/dynamics/cloth_model.h"
#include "core/dynamics/state.h"

namespace pleat {

/// A moving sheet: its mesh, equations and state.
struct MovingSheet {
  const QuadMesh& mesh;
  const ClothModel& model;
  const State& state;
};

/// The state of `old` on another refinement of the same base mesh. Vertices that both share keep
/// position and velocity to the bit; others take the mean of their parents.
State carried_state(const MovingSheet& old, const QuadMesh& mesh);

/// Rest lengths [m], one per spring of `fresh`, with which the new cloth starts on the
/// accelerations that the old one had: force per width and mass goes on as it was, whatever the new
/// mesh and fabric. Relax them to the model's own slowly, and the change of mesh or fabric does not
/// shake the cloth.
std::vector<double> carried_rest_lengths(const MovingSheet& old, const MovingSheet& fresh);

}  // namespace pleat
