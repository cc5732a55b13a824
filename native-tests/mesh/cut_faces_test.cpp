#include "core/mesh/cut_faces.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/base/random.h"
#include "core/mesh/mesh_fault.h"
#include "native-tests/support/meshes.h"
#include "native-tests/support/topology.h"

namespace pleat {
namespace {

std::vector<VertexId> vertices(std::initializer_list<int> numbers) {
  return {numbers.begin(), numbers.end()};
}

CutFaces faces_of(const QuadMesh& mesh) {
  std::vector<VertexId> corners;
  for (const QuadFace& face : mesh.faces())
    if (face.active()) corners.insert(corners.end(), face.corners.begin(), face.corners.end());
  return {std::move(corners), 4, mesh.n_vertices()};
}

CutFaces faces_of(const TriangleMesh& mesh) {
  std::vector<VertexId> corners;
  for (const Triangle& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  return {std::move(corners), 3, mesh.n_vertices()};
}

TriangleMesh torn(TriangleMesh mesh, const CutFaces& faces) {
  mesh.rest_positions = with_split(mesh.rest_positions, faces.origins());
  auto corner = faces.corners().begin();
  for (Triangle& t : mesh.triangles)
    for (VertexId& v : t) v = *corner++;
  return mesh;
}

TriangleMesh torn(QuadMesh mesh, const CutFaces& faces) {
  mesh.tear(faces.corners(), faces.origins());
  return mesh.triangle_mesh();
}

Topology topology_of(const TriangleMesh& mesh) {
  return topology(mesh.triangles, mesh.n_vertices());
}

/// Cuts at a vertex of a mesh along a line, in the plane z = 0.
std::vector<VertexId> cut_along(CutFaces& faces, const Positions& x, VertexId vertex,
                                const Vec3& line, std::span<const char> is_held = {}) {
  const Positions places = with_split(x, faces.origins());
  const Vec3 normal = line.cross(Vec3::UnitZ());
  std::vector<FaceId> far;
  for (const FaceId face : faces.faces_at(vertex)) {
    double side = 0;
    for (const VertexId v : faces.corners_of(face))
      side += normal.dot(places.col(v) - places.col(vertex));
    if (side > 0) far.push_back(face);
  }
  return faces.cut(vertex, far, is_held);
}

}  // namespace

TEST_CASE("cut_faces: a strip of two faces falls in two", "[mesh]") {
  CutFaces faces(vertices({0, 3, 4, 1, 1, 4, 5, 2}), 4, 6);
  CHECK(faces.cut(VertexId(4), std::array{FaceId(1)}, {}) == vertices({4, 1}));
  CHECK(faces.corners() == vertices({0, 3, 4, 1, 7, 6, 5, 2}));
  CHECK(faces.origins() == vertices({4, 1}));
}

TEST_CASE("cut_faces: a cut at a vertex inside is one slit", "[mesh]") {
  const QuadMesh sheet = lying_sheet(4);
  CutFaces faces = faces_of(sheet);
  CHECK(cut_along(faces, sheet.rest_positions(), VertexId(12), Vec3::UnitX()) == vertices({12}));
  const Topology slit = topology_of(torn(sheet, faces));
  CHECK(slit.is_manifold);
  CHECK(slit.n_components == 1);
  CHECK(slit.n_border_loops == 2);
  CHECK(slit.euler == 0);
}

TEST_CASE("cut_faces: a cut that meets a border or an older cut opens it", "[mesh]") {
  const QuadMesh sheet = lying_sheet(4);
  CutFaces faces = faces_of(sheet);
  cut_along(faces, sheet.rest_positions(), VertexId(7), Vec3::UnitX());
  const Topology notch = topology_of(torn(sheet, faces));
  CHECK(notch.is_manifold);
  CHECK(notch.n_border_loops == 1);
  CHECK(notch.euler == 1);
  CHECK(faces.origins().size() == 2);
  // Two further on: the slit between it and the notch becomes a part of the notch.
  CHECK(cut_along(faces, sheet.rest_positions(), VertexId(17), Vec3::UnitX()).size() == 3);
  const Topology through = topology_of(torn(sheet, faces));
  CHECK(through.is_manifold);
  CHECK(through.n_components == 2);
  CHECK(through.n_border_loops == 2);
  CHECK(through.euler == 2);
}

TEST_CASE("cut_faces: cut straight through, a sheet is two", "[mesh]") {
  const int cells = GENERATE(2, 5, 8);
  const QuadMesh sheet = lying_sheet(cells);
  CutFaces faces = faces_of(sheet);
  for (int row = 0; row <= cells; ++row)
    cut_along(faces, sheet.rest_positions(), VertexId(row * (cells + 1) + 1), Vec3::UnitX());
  const Topology halves = topology_of(torn(sheet, faces));
  CHECK(halves.is_manifold);
  CHECK(halves.n_components == 2);
  CHECK(halves.n_border_loops == 2);
  CHECK(halves.euler == 2);
  CHECK(faces.origins().size() == static_cast<std::size_t>(cells + 1));
}

TEST_CASE("cut_faces: what is held does not split, nor what would cut it off", "[mesh]") {
  const QuadMesh sheet = lying_sheet(4);
  CutFaces faces = faces_of(sheet);
  const std::vector<VertexId> before = faces.corners();
  std::vector<char> is_held(25, 0);
  is_held[2] = 1;  // a vertex of the border where x starts
  CHECK(cut_along(faces, sheet.rest_positions(), VertexId(2), Vec3::UnitX(), is_held).empty());
  CHECK(cut_along(faces, sheet.rest_positions(), VertexId(7), Vec3::UnitX(), is_held).empty());
  CHECK(faces.corners() == before);
  CHECK(cut_along(faces, sheet.rest_positions(), VertexId(7), Vec3::UnitY(), is_held).size() == 1);
}

TEST_CASE("cut_faces: nothing is cut where all faces are on one side", "[mesh]") {
  const QuadMesh sheet = lying_sheet(3);
  CutFaces faces = faces_of(sheet);
  const auto around = faces.faces_at(VertexId(5));
  CHECK(faces.cut(VertexId(5), {}, {}).empty());
  CHECK(faces.cut(VertexId(5), std::vector<FaceId>(around.begin(), around.end()), {}).empty());
  CHECK(faces.cut(VertexId(0), std::array{FaceId(0)}, {}).empty());
}

TEST_CASE("cut_faces: whatever is cut stays sound, in place and as large", "[mesh]") {
  const int seed = GENERATE(range(0, 200));
  CAPTURE(seed);
  Random random(static_cast<std::uint64_t>(seed));
  const auto check = [&](const auto& mesh, const TriangleMesh& whole) {
    CutFaces faces = faces_of(mesh);
    const std::vector<VertexId> corners = faces.corners();
    for (int c = 0; c < 40; ++c) {
      const auto n = whole.n_vertices() + static_cast<std::int64_t>(faces.origins().size());
      const double angle = random.uniform(0, 6.3);
      cut_along(faces, whole.rest_positions, VertexId(random.below(n)),
                {std::cos(angle), std::sin(angle), 0});
    }
    REQUIRE(!faces.origins().empty());
    const TriangleMesh cut = torn(mesh, faces);
    CHECK(topology_of(cut).is_manifold);
    CHECK_FALSE(mesh_fault(cut.rest_positions, cut.triangles, 0));
    const Positions places = with_split(whole.rest_positions, faces.origins());
    for (std::size_t c = 0; c < corners.size(); ++c)
      REQUIRE(places.col(faces.corners()[c]) == whole.rest_positions.col(corners[c]));
    const double area = vertex_areas(whole).sum();
    CHECK(vertex_areas(cut).sum() == Approx(area).epsilon(1e-12));
  };
  const QuadMesh sheet = lying_sheet(6);
  check(sheet, sheet.triangle_mesh());
  const auto pattern = kTriangulations[static_cast<std::size_t>(seed) % kTriangulations.size()];
  const TriangleMesh mesh = triangulated_sheet(pattern, 6, 6, 0.1);
  check(mesh, mesh);
}

TEST_CASE("cut_faces: torn quads keep areas, threads and diagonals", "[mesh]") {
  QuadMesh sheet = lying_sheet(2);
  sheet.refine_uniformly(1);
  const QuadMesh whole = sheet;
  CutFaces faces = faces_of(sheet);
  for (int row = 0; row <= 4; ++row)
    for (int v = 0; v < whole.n_vertices(); ++v)
      if (whole.rest_positions().col(v).isApprox(Vec3(0.25 * row, 0.25, 0)))
        cut_along(faces, whole.rest_positions(), VertexId(v), Vec3::UnitX());
  sheet.tear(faces.corners(), faces.origins());
  CHECK(topology_of(sheet.triangle_mesh()).n_components == 2);
  const auto n = static_cast<std::size_t>(whole.n_vertices());
  CHECK(static_cast<std::size_t>(sheet.n_vertices()) == n + faces.origins().size());
  REQUIRE(sheet.faces().size() == whole.faces().size());
  for (std::size_t f = 0; f < whole.faces().size(); ++f) {
    const FaceId face(static_cast<std::int64_t>(f));
    CHECK(sheet.faces()[f].diagonal_02 == whole.faces()[f].diagonal_02);
    CHECK(sheet.faces()[f].level == whole.faces()[f].level);
    CHECK(sheet.area(face) == whole.area(face));
  }
  CHECK(sheet.triangle_mesh().warp_directions == whole.triangle_mesh().warp_directions);
  CHECK(sheet.vertex_areas().sum() == Approx(whole.vertex_areas().sum()).epsilon(1e-12));
}

}  // namespace pleat
