#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "core/base/check.h"
#include "core/base/joined_sets.h"
#include "core/modal/carrying_volume.h"

namespace pleat {
namespace {

void check_windings(const std::vector<Triangle>& triangles) {
  std::map<std::pair<int, int>, int> directed;
  for (const Triangle& triangle : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::pair<int, int> ends{triangle[k], triangle[(k + 1) % 3]};
      if (++directed[ends] > 1)
        throw InputError("", "expected triangles that are wound alike; two go from vertex " +
                                 std::to_string(ends.first) + " to " + std::to_string(ends.second));
    }
}

/// Unit normals of the vertices, of the triangles around them by area; zero where these cancel out.
Positions vertex_normals(const Positions& surface, const std::vector<Triangle>& triangles) {
  Positions normals = Positions::Zero(3, surface.cols());
  for (const auto& [a, b, c] : triangles) {
    const Vec3 normal = (surface.col(b) - surface.col(a)).cross(surface.col(c) - surface.col(a));
    for (const VertexId corner : {a, b, c}) normals.col(corner) += normal;
  }
  for (Eigen::Index v = 0; v < normals.cols(); ++v) {
    const double length = normals.col(v).norm();
    if (length > 0) normals.col(v) /= length;
  }
  return normals;
}

}  // namespace

std::vector<int> surface_parts(Eigen::Index n_vertices, const std::vector<Triangle>& triangles) {
  JoinedSets sets(static_cast<std::size_t>(n_vertices));
  for (const auto& [a, b, c] : triangles) {
    sets.join(a, b);
    sets.join(a, c);
  }
  return sets.numbers();
}

double mean_edge_length(const Positions& surface, const std::vector<Triangle>& triangles) {
  const std::vector<MeshEdge> edges = mesh_edges(triangles);
  double sum = 0;
  for (const MeshEdge& edge : edges) sum += (surface.col(edge.a) - surface.col(edge.b)).norm();
  return edges.empty() ? 0 : sum / static_cast<double>(edges.size());
}

CarryingVolume shell_volume(const Positions& surface, const std::vector<Triangle>& triangles,
                            double thickness) {
  PLEAT_CHECK(thickness > 0, "a shell is thick");
  PLEAT_CHECK(surface.allFinite(), "a surface has finite vertices");
  check_windings(triangles);
  const Eigen::Index n = surface.cols();
  const Positions half = thickness / 2 * vertex_normals(surface, triangles);
  CarryingVolume result;
  Positions& positions = result.volume.rest_positions;
  positions.resize(3, 2 * n);
  positions.leftCols(n) = surface - half;
  positions.rightCols(n) = surface + half;

  for (std::size_t f = 0; f < triangles.size(); ++f) {
    // Every side of a prism is cut from the lower end of its smaller vertex, on both sides alike.
    Triangle sorted = triangles[f];
    std::sort(sorted.begin(), sorted.end());
    const auto below = [](VertexId v) { return v; };
    const auto above = [n](VertexId v) { return VertexId(n + v); };
    const auto [a, b, c] = sorted;
    const auto place =
        std::find(triangles[f].begin(), triangles[f].end(), a) - triangles[f].begin();
    const bool is_turned = triangles[f][static_cast<std::size_t>(place + 1) % 3] != b;
    for (Tet tet :
         {Tet{below(a), below(b), below(c), above(c)}, Tet{below(a), below(b), above(c), above(b)},
          Tet{below(a), above(b), above(c), above(a)}}) {
      if (is_turned) std::swap(tet[1], tet[2]);
      if (tet_volume(positions, tet) <= 0)
        throw InputError("", "expected a surface that bends more gently than a shell of " +
                                 std::to_string(thickness) + " m is thick; triangle " +
                                 std::to_string(f) + " of it turns inside out");
      result.volume.tets.push_back(tet);
    }
  }
  if (!hangs_together_by_faces(result.volume))
    throw InputError("",
                     "expected a surface whose parts hang together by edges; some of it is "
                     "joined at a vertex alone");
  std::vector<Eigen::Triplet<double, int>> weights;
  for (int v = 0; v < n; ++v) {
    weights.emplace_back(v, v, 0.5);
    weights.emplace_back(static_cast<int>(n) + v, v, 0.5);
  }
  result.embedding.resize(2 * n, n);
  result.embedding.setFromTriplets(weights.begin(), weights.end());
  return result;
}

}  // namespace pleat
