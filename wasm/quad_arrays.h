#pragma once

#include <cstdint>
#include <vector>

#include "core/mesh/quad_mesh.h"

namespace pleat {

/// A mesh of quads as it is drawn, and its faces.
struct QuadArrays {
  /// Two for each active face in their order, or more where vertices hang on its edges, so that
  /// neighbours share all edges and nothing shines through.
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> triangle_faces;  ///< face of each triangle, counted among active ones
  std::vector<std::uint32_t> edges;           ///< pairs of vertices, each once
  std::vector<std::uint32_t> hanging;
  /// Each active face: its number, level, parent (or -1), corners.
  std::vector<std::int32_t> faces;
  /// Up to four vertices whose mean each vertex is at rest, -1 for none; parents come first.
  std::vector<std::int32_t> parents;
};

constexpr std::size_t kNumbersPerFace = 7;

QuadArrays quad_arrays(const QuadMesh& mesh);

}  // namespace pleat
