#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "core/base/check.h"
#include "core/base/random.h"
#include "core/mesh/quad_mesh.h"

namespace pleat {
namespace {

constexpr int kRound = 8;  // faces around the tube
constexpr int kDown = 5;

/// A cone-shaped tube, open above and below, wound outward.
QuadPatch cone_tube() {
  QuadPatch patch;
  patch.rest_positions.resize(3, kRound * (kDown + 1));
  patch.rest_coordinates.resize(2, kRound * (kDown + 1));
  for (int r = 0; r <= kDown; ++r) {
    for (int c = 0; c < kRound; ++c) {
      const double angle = 2 * M_PI * c / kRound;
      const double radius = 0.2 + 0.02 * r;
      patch.rest_positions.col(r * kRound + c) << radius * std::sin(angle), -0.1 * r,
          radius * std::cos(angle);
      patch.rest_coordinates.col(r * kRound + c) << 0.1 * r, 0.15 * c;
    }
  }
  const auto id = [](int r, int c) { return VertexId(r * kRound + c % kRound); };
  for (int r = 0; r < kDown; ++r)
    for (int c = 0; c < kRound; ++c)
      patch.quads.push_back({id(r, c), id(r + 1, c), id(r + 1, c + 1), id(r, c + 1)});
  return patch;
}

QuadMesh randomly_refined(std::uint64_t seed, int n_splits) {
  Random random(seed);
  QuadMesh mesh = QuadMesh::from_patch(cone_tube());
  for (int i = 0; i < n_splits; ++i) {
    const FaceId face(random.below(static_cast<std::int64_t>(mesh.faces().size())));
    if (mesh.faces()[face].level < 5) mesh.refine(std::array{face});
  }
  return mesh;
}

/// Faces at each edge of the finest pieces: what an independent look at geometry sees.
std::map<std::pair<int, int>, std::vector<int>> faces_at_edges(const QuadMesh& mesh) {
  std::map<std::pair<int, int>, std::vector<int>> faces;
  for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
    const QuadFace& face = mesh.faces()[f];
    if (!face.active()) continue;
    for (int k = 0; k < 4; ++k) {
      const auto [low, high] = std::minmax(face.corners[k].value, face.corners[(k + 1) % 4].value);
      faces[{low, high}].push_back(static_cast<int>(f));
    }
  }
  return faces;
}

}  // namespace

TEST_CASE("graded mesh: at an edge faces differ by one level at most", "[mesh]") {
  const int seed = GENERATE(1, 2, 3, 4);
  const QuadMesh mesh = randomly_refined(static_cast<std::uint64_t>(seed), 60);
  const auto faces = faces_at_edges(mesh);
  const auto hanging = mesh.hanging_vertices();
  int n_borders = 0;
  for (const HangingVertex& h : hanging) {
    const auto side = [&](VertexId a, VertexId b) {
      const auto [low, high] = std::minmax(a.value, b.value);
      const auto at = faces.find({low, high});
      REQUIRE(at != faces.end());
      REQUIRE(at->second.size() == 1);
      return mesh.faces()[static_cast<std::size_t>(at->second[0])].level;
    };
    const int coarse = side(h.parents[0], h.parents[1]);
    CHECK(side(h.parents[0], h.vertex) == coarse + 1);
    CHECK(side(h.vertex, h.parents[1]) == coarse + 1);
    ++n_borders;
  }
  CHECK(n_borders > 10);
  // Every edge with one face is the border of the tube or at a hanging vertex.
  std::set<std::pair<int, int>> explained;
  for (const HangingVertex& h : hanging) {
    explained.insert(std::minmax(h.parents[0].value, h.parents[1].value));
    for (const VertexId p : h.parents) explained.insert(std::minmax(p.value, h.vertex.value));
  }
  for (const auto& [edge, at] : faces) {
    const double u = mesh.rest_coordinates()(0, edge.first);
    const bool is_border = u == mesh.rest_coordinates()(0, edge.second) && (u == 0 || u == 0.5);
    CHECK((at.size() == 2 || is_border || explained.count(edge) == 1));
  }
}

TEST_CASE("graded mesh: the splits that balance asks for are known in advance", "[mesh]") {
  const int seed = GENERATE(7, 8, 9);
  QuadMesh mesh = randomly_refined(static_cast<std::uint64_t>(seed), 30);
  std::size_t most = 0;
  for (int f = 0; f < static_cast<int>(mesh.faces().size()); ++f) {
    const FaceId face(f);
    if (!mesh.faces()[face].active() || mesh.faces()[face].level == 5) continue;
    const std::vector<FaceId> expected = mesh.balanced_splits(face);
    QuadMesh refined = mesh;
    refined.refine(std::array{face});
    std::vector<FaceId> splits;
    for (std::size_t child = mesh.faces().size(); child < refined.faces().size(); child += 4)
      splits.push_back(refined.faces()[child].parent);
    CHECK(splits == expected);
    CHECK(splits.back() == face);
    most = std::max(most, splits.size());
  }
  CHECK(most > 2);
  CHECK_THROWS_AS(mesh.balanced_splits(FaceId(100000)), ContractError);
}

TEST_CASE("graded mesh: a hanging vertex lies in the middle of parents that do not hang",
          "[mesh]") {
  const QuadMesh mesh = randomly_refined(5, 60);
  std::set<int> hanging;
  for (const HangingVertex& h : mesh.hanging_vertices()) {
    CHECK(hanging.insert(h.vertex).second);
    const Positions& x = mesh.rest_positions();
    CHECK((x.col(h.vertex) - (x.col(h.parents[0]) + x.col(h.parents[1])) / 2).norm() < 1e-15);
  }
  for (const HangingVertex& h : mesh.hanging_vertices())
    for (const VertexId parent : h.parents) CHECK(hanging.count(parent) == 0);
}

TEST_CASE("graded mesh: refinement keeps the area to rounding", "[mesh]") {
  const QuadMesh base = QuadMesh::from_patch(cone_tube());
  const QuadMesh mesh = randomly_refined(6, 60);
  CHECK(mesh.vertex_areas().sum() == Approx(base.vertex_areas().sum()).epsilon(1e-14));
  for (const HangingVertex& h : mesh.hanging_vertices()) CHECK(mesh.vertex_areas()[h.vertex] == 0);
}

TEST_CASE("graded mesh: faces refined one by one make the uniform mesh", "[mesh]") {
  QuadMesh uniform = QuadMesh::from_patch(cone_tube());
  uniform.refine_uniformly(1);
  QuadMesh graded = QuadMesh::from_patch(cone_tube());
  std::vector<FaceId> all;
  for (int f = 0; f < graded.n_base_faces(); ++f) all.emplace_back(f);
  graded.refine(all);
  CHECK(graded.rest_positions() == uniform.rest_positions());
  CHECK(graded.hanging_vertices().empty());
}

TEST_CASE("graded mesh: round a tube the coordinate grows up to the seam", "[mesh]") {
  QuadMesh mesh = QuadMesh::from_patch(cone_tube());
  mesh.refine_uniformly(2);
  std::map<long, std::map<double, double>> rows;  // coordinate down: {angle: coordinate round}
  for (int i = 0; i < mesh.n_vertices(); ++i) {
    const Vec3 x = mesh.rest_positions().col(i);
    const double angle = std::atan2(x.x(), x.z());
    rows[std::lround(mesh.rest_coordinates()(0, i) * 1e6)]
        [angle < -1e-9 ? angle + 2 * M_PI : angle] = mesh.rest_coordinates()(1, i);
  }
  CHECK(rows.size() == 4 * kDown + 1);
  for (const auto& [u, row] : rows) {
    CHECK(row.size() == 4 * kRound);
    double last = -1;
    for (const auto& [angle, v] : row) {
      CHECK(v > last);
      last = v;
    }
  }
}

TEST_CASE("graded mesh: unsound faces are named", "[mesh]") {
  QuadPatch twice = cone_tube();
  twice.quads[7][2] = twice.quads[7][0];
  CHECK_THROWS_WITH(QuadMesh::from_patch(twice), Catch::Contains("four different corners"));
  QuadPatch turned = cone_tube();
  std::swap(turned.quads[3][1], turned.quads[3][3]);
  CHECK_THROWS_AS(QuadMesh::from_patch(turned), InputError);
  QuadPatch flat = cone_tube();
  for (int k = 0; k < 4; ++k) flat.rest_positions.col(flat.quads[2][k]).setConstant(1);
  CHECK_THROWS_WITH(QuadMesh::from_patch(flat), Catch::Contains("area"));
  QuadPatch third = cone_tube();
  third.quads.push_back(third.quads[4]);
  CHECK_THROWS_WITH(QuadMesh::from_patch(third), Catch::Contains("at most two faces"));
  QuadPatch alone = cone_tube();
  alone.quads.resize(alone.quads.size() - kRound);
  CHECK_THROWS_WITH(QuadMesh::from_patch(alone), Catch::Contains("a vertex without"));
}

}  // namespace pleat
