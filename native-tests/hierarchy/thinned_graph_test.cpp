#include "core/hierarchy/thinned_graph.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/hierarchy/mesh_hierarchy.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

Neighbours neighbours_of(const TriangleMesh& mesh) {
  Neighbours neighbours(static_cast<std::size_t>(mesh.n_vertices()));
  for (const MeshEdge& edge : mesh_edges(mesh.triangles)) {
    neighbours[edge.a].push_back(edge.b);
    neighbours[edge.b].push_back(edge.a);
  }
  return neighbours;
}

bool is_kept(const ThinnedGraph& graph, VertexId v) {
  return std::binary_search(graph.kept.begin(), graph.kept.end(), v);
}

}  // namespace

TEST_CASE("thinned graph: whatever is out has two neighbours that stay, and no more may go",
          "[multigrid]") {
  const auto pattern = GENERATE(from_range(kTriangulations));
  CAPTURE(static_cast<int>(pattern));
  const TriangleMesh mesh = triangulated_sheet(pattern, 12, 12, 0.1);
  const Neighbours neighbours = neighbours_of(mesh);
  const auto n = static_cast<std::size_t>(mesh.n_vertices());
  std::vector<bool> is_fixed(n, false);
  is_fixed[5] = is_fixed[77] = true;
  const ThinnedGraph graph = thinned(neighbours, mesh.rest_positions, is_fixed);
  CHECK(graph.kept.size() < n / 2);
  CHECK(is_kept(graph, VertexId(5)));
  CHECK(is_kept(graph, VertexId(77)));
  const auto n_kept = [&](VertexId v) {
    return std::count_if(neighbours[v].begin(), neighbours[v].end(),
                         [&](VertexId other) { return is_kept(graph, other); });
  };
  for (std::size_t i = 0; i < n; ++i) {
    const VertexId v(static_cast<std::int64_t>(i));
    if (!is_kept(graph, v)) {
      CHECK(n_kept(v) >= 2);
      continue;
    }
    const bool may_go = !is_fixed[i] && n_kept(v) >= 2 &&
                        std::all_of(neighbours[v].begin(), neighbours[v].end(),
                                    [&](VertexId o) { return is_kept(graph, o) || n_kept(o) > 2; });
    CHECK_FALSE(may_go);
  }
}

TEST_CASE("thinned graph: edges join what stays, each once, and keep the mesh in one piece",
          "[multigrid]") {
  const TriangleMesh mesh = triangulated_sheet(Triangulation::jittered, 12, 12, 0.1);
  const ThinnedGraph graph =
      thinned(neighbours_of(mesh), mesh.rest_positions,
              std::vector<bool>(static_cast<std::size_t>(mesh.n_vertices()), false));
  CHECK(std::is_sorted(graph.edges.begin(), graph.edges.end()));
  CHECK(std::adjacent_find(graph.edges.begin(), graph.edges.end()) == graph.edges.end());
  std::vector<VertexId> reached{graph.kept[0]};
  for (const auto& [a, b] : graph.edges) {
    CHECK(a < b);
    CHECK(is_kept(graph, a));
    CHECK(is_kept(graph, b));
  }
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const auto& [a, b] : graph.edges)
      for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}})
        if (from == reached[i] && std::find(reached.begin(), reached.end(), to) == reached.end())
          reached.push_back(to);
  CHECK(reached.size() == graph.kept.size());
}

TEST_CASE("hierarchy: thinned levels have lengths and transfers as collapsed ones do",
          "[multigrid]") {
  const TriangleMesh mesh = triangulated_sheet(Triangulation::crossed, 16, 16, 0.1);
  HierarchyOptions options;
  options.selection = LevelSelection::thinned;
  const MeshHierarchy hierarchy = mesh_hierarchy(mesh, {}, options);
  REQUIRE(hierarchy.shortage.empty());
  for (std::size_t k = 1; k < hierarchy.levels.size(); ++k) {
    const MeshLevel& level = hierarchy.levels[k];
    const Transfer& transfer = hierarchy.levels[k - 1].from_coarser;
    const Positions places = positions_on(level, mesh.rest_positions);
    for (const LevelEdge& edge : level.edges) {
      const double straight = (places.col(edge.a) - places.col(edge.b)).norm();
      CHECK(edge.chord == Approx(straight).epsilon(1e-12));
      CHECK(edge.geodesic == Approx(straight).epsilon(1e-9));
    }
    const Positions ones = Positions::Ones(3, level.n_vertices());
    CHECK((transfer * ones - Positions::Ones(3, transfer.n_rows())).cwiseAbs().maxCoeff() < 1e-12);
  }
}

}  // namespace pleat
