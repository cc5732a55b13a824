#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>
#include <utility>

#include "core/base/ids.h"
#include "core/base/vec.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// Two parts of surfaces that may come to pass through each other: a vertex and a face, or two
/// edges. The sides have no vertex in common.
struct SurfacePair {
  enum class Kind : std::uint8_t { vertex_face, edges };
  Kind kind = Kind::vertex_face;
  /// The vertex, then the face's corners; or the first edge's ends, then the second's. Each side's
  /// ascend, and the edge with the lesser first end comes first: whoever names the sides in
  /// whatever order makes the same pair, with the same rounding.
  std::array<VertexId, 4> vertices;

  /// Vertices of the first side.
  int n_first() const { return kind == Kind::vertex_face ? 1 : 2; }
  /// Differences from each vertex of the first side to each of the second.
  int n_differences() const { return kind == Kind::vertex_face ? 3 : 4; }
};

inline SurfacePair vertex_face_pair(VertexId vertex, Triangle face) {
  std::sort(face.begin(), face.end());
  return {SurfacePair::Kind::vertex_face, {vertex, face[0], face[1], face[2]}};
}

inline SurfacePair edge_pair(std::array<VertexId, 2> a, std::array<VertexId, 2> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  if (b < a) std::swap(a, b);
  return {SurfacePair::Kind::edges, {a[0], a[1], b[0], b[1]}};
}

inline bool operator==(const SurfacePair& a, const SurfacePair& b) {
  return a.kind == b.kind && a.vertices == b.vertices;
}
/// Order of lists of pairs: by kind, then by vertices.
inline bool operator<(const SurfacePair& a, const SurfacePair& b) {
  return std::tie(a.kind, a.vertices) < std::tie(b.kind, b.vertices);
}

/// Differences x_b - x_a of every vertex b of the second side from every a of the first [m], b
/// running faster; `n_differences()` of them, the rest zero.
inline std::array<Vec3, 4> pair_differences(const SurfacePair& pair,
                                            const PositionsView& positions) {
  std::array<Vec3, 4> differences{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  const int n_first = pair.n_first();
  int k = 0;
  for (int a = 0; a < n_first; ++a)
    for (int b = n_first; b < 4; ++b)
      differences[k++] = positions.col(pair.vertices[b]) - positions.col(pair.vertices[a]);
  return differences;
}

}  // namespace pleat
