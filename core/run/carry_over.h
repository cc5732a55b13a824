#pragma once

#include <vector>

#include "core/model/cloth_model.h"
#include "core/model/state.h"

namespace pleat {

/// A moving sheet: its mesh, equations and state.
struct MovingSheet {
  const QuadMesh& mesh;
  const ClothModel& model;
  const State& state;
};

/// The new cloth's mass over the old one's.
double mass_ratio(const MovingSheet& old, const MovingSheet& fresh);

/// Places of vertices [m], or any other columns, on another refinement of the same base mesh.
/// Vertices that both share keep theirs to the bit; others are interpolated along the mesh lines,
/// exactly where the cloth is a surface of second degree. Source: docs/methods/carry_over.md.
Positions carried_positions(const Positions& old, const QuadMesh& mesh);

/// The state of `old` on another refinement of the same base mesh: carried_positions of both,
/// hanging vertices in the middle of their parents.
State carried_state(const MovingSheet& old, const QuadMesh& mesh);

/// Rest lengths [m], one per spring of `fresh`, with which the new cloth starts on the
/// accelerations that the old one had. On the same mesh every spring goes on pulling as it did per
/// mass; on another one tension per width does, compression does not. In softer cloth, stretch
/// beyond what the sheet's weight and swing can ask for does not go on either. Relaxed to the
/// model's own slowly, they do not shake the cloth. Both models have rest coordinates.
std::vector<double> carried_rest_lengths(const MovingSheet& old, const MovingSheet& fresh);

/// Forces on the vertices of `old` [N], one column each, or none at all, as forces on those of
/// `fresh` that accelerate them alike.
Positions carried_forces(const Positions& forces, const MovingSheet& old, const MovingSheet& fresh);

}  // namespace pleat
