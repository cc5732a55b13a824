#pragma once

#include "core/linalg/sparse.h"
#include "core/mesh/triangle_mesh.h"
#include "core/modal/tet_mesh.h"

namespace pleat {

/// A volume that carries a surface along.
struct CarryingVolume {
  TetMesh volume;
  /// Volume vertices x surface vertices, columns of sum 1: surface = positions of the volume *
  /// this.
  SparseMatrix embedding;

  Positions surface(const Positions& volume_positions) const {
    return volume_positions * embedding;
  }
};

/// Cubes, each cut into six tetrahedra along the same diagonal (Freudenthal), that cover a closed
/// surface: those that it passes and those inside. Each surface vertex lies in one of the
/// tetrahedra, by barycentric coordinates.
///
/// edge  of the cubes [m], positive
///
/// Throws InputError where the surface is open, turns its triangles against each other, goes round
/// the middle of a cube twice or both ways, as where it passes through itself, or would take more
/// than kMaxVertices.
///
/// Source: Freudenthal, Simplizialzerlegungen von beschraenkter Flachheit, Annals of Mathematics
/// 43, 1942.
CarryingVolume lattice_volume(const Positions& surface, const std::vector<Triangle>& triangles,
                              double edge);

/// The triangles of a surface, open or closed, thickened by half a thickness to each side; each
/// prism is three tetrahedra, which meet their neighbours face to face. A surface vertex is the
/// middle of two of the volume, `i` below it and `n + i` above it.
///
/// thickness  [m], positive
///
/// Throws InputError where the surface bends or folds so sharply that the volume would turn inside
/// out, or turns its triangles against each other.
CarryingVolume shell_volume(const Positions& surface, const std::vector<Triangle>& triangles,
                            double thickness);

/// The part that each vertex belongs to, from 0: those of a part hang together by edges.
std::vector<int> surface_parts(Eigen::Index n_vertices, const std::vector<Triangle>& triangles);

/// Mean length of the triangles' edges, each counted once [m].
double mean_edge_length(const Positions& surface, const std::vector<Triangle>& triangles);

}  // namespace pleat
