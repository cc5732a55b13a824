#pragma once

#include "core/hierarchy/mesh_hierarchy.h"

namespace pleat {

/// How a level of quadrics misses the surface that it stands for. With all guards (CollapseGuards)
/// no border strays and no edge is crowded; triangles count as turned only where the surface is
/// crumpled within an edge's length, as those of the finest mesh do themselves.
struct LevelFaults {
  /// Triangles that look against the mean normal of the finest mesh at their corners, or whose
  /// height is below a thousandth of their longest side.
  int turned_triangles = 0;
  /// Border edges with an end that is on no border of the finest mesh.
  int strayed_borders = 0;
  /// Edges of more than two triangles.
  int crowded_edges = 0;
  /// Share of the finest mesh's area in space; a triangle that looks against it is subtracted.
  /// Round cloth loses some to chords.
  double covered_share = 1;
};

/// level   of a hierarchy of `finest`, with triangles
/// finest  sound (mesh_fault)
LevelFaults level_faults(const MeshLevel& level, const TriangleMesh& finest);

}  // namespace pleat
