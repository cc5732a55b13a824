#include "core/mesh/quad_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "core/base/check.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

QuadMesh refined_sheet(int rows, int columns, int levels) {
  SheetShape shape;
  shape.rows = rows;
  shape.columns = columns;
  shape.width = 0.8;
  shape.height = 1.3;
  QuadMesh mesh = QuadMesh::sheet(shape);
  mesh.refine_uniformly(levels);
  return mesh;
}

}  // namespace

TEST_CASE("quad_mesh: a refined sheet has the vertices and faces of the finer grid", "[mesh]") {
  const int levels = GENERATE(0, 1, 2, 3);
  CAPTURE(levels);
  const QuadMesh mesh = refined_sheet(3, 5, levels);
  const int factor = 1 << levels;
  CHECK(mesh.n_vertices() == (3 * factor + 1) * (5 * factor + 1));
  const auto n_active = std::count_if(mesh.faces().begin(), mesh.faces().end(),
                                      [](const QuadFace& face) { return face.active(); });
  CHECK(n_active == 15 * factor * factor);
}

TEST_CASE("quad_mesh: refinement leaves earlier vertices in place to the bit", "[mesh]") {
  const QuadMesh base = refined_sheet(3, 5, 1);
  const QuadMesh fine = refined_sheet(3, 5, 3);
  CHECK(fine.rest_positions().leftCols(base.n_vertices()) == base.rest_positions());
  CHECK(fine.rest_coordinates().leftCols(base.n_vertices()) == base.rest_coordinates());
}

TEST_CASE("quad_mesh: a refined sheet is the finer grid's set of points", "[mesh]") {
  const QuadMesh fine = refined_sheet(2, 4, 2);
  const QuadMesh grid = refined_sheet(8, 16, 0);
  std::set<std::pair<long, long>> expected;
  std::set<std::pair<long, long>> found;
  const auto key = [](const RestCoordinates& uv, int i) {
    return std::pair(std::lround(uv(0, i) * 1e9), std::lround(uv(1, i) * 1e9));
  };
  for (int i = 0; i < grid.n_vertices(); ++i) expected.insert(key(grid.rest_coordinates(), i));
  for (int i = 0; i < fine.n_vertices(); ++i) found.insert(key(fine.rest_coordinates(), i));
  CHECK(found == expected);
}

TEST_CASE("quad_mesh: every refinement vertex is the mean of parents that come before it",
          "[mesh]") {
  const QuadMesh mesh = refined_sheet(2, 3, 3);
  for (int i = 0; i < mesh.n_vertices(); ++i) {
    const VertexParents& parents = mesh.parents()[static_cast<std::size_t>(i)];
    if (parents.count == 0) {
      CHECK(i < 3 * 4);
      continue;
    }
    Vec3 mean = Vec3::Zero();
    for (int k = 0; k < parents.count; ++k) {
      REQUIRE(parents.vertices[k] < i);
      mean += mesh.rest_positions().col(parents.vertices[k]) / parents.count;
    }
    CHECK((mean - mesh.rest_positions().col(i)).norm() < 1e-15);
  }
}

TEST_CASE("quad_mesh: edges 0-1 lie along warp and edges 0-3 along weft at every level", "[mesh]") {
  const QuadMesh mesh = refined_sheet(2, 3, 2);
  const RestCoordinates& uv = mesh.rest_coordinates();
  for (const QuadFace& face : mesh.faces()) {
    const auto edge = [&](int from, int to) {
      return Eigen::Vector2d(uv.col(face.corners[to]) - uv.col(face.corners[from]));
    };
    CHECK(edge(0, 1).x() > 0);
    CHECK(std::abs(edge(0, 1).y()) < 1e-15);
    CHECK(edge(0, 3).y() > 0);
    CHECK(std::abs(edge(0, 3).x()) < 1e-15);
  }
}

TEST_CASE("quad_mesh: child k holds corner k and knows its parent and level", "[mesh]") {
  const QuadMesh mesh = refined_sheet(2, 3, 2);
  for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
    const QuadFace& face = mesh.faces()[f];
    if (face.active()) continue;
    for (int k = 0; k < 4; ++k) {
      const QuadFace& child = mesh.faces()[face.children[k]];
      CHECK(child.corners[k] == face.corners[k]);
      CHECK(child.parent == static_cast<int>(f));
      CHECK(child.level == face.level + 1);
    }
  }
}

TEST_CASE("quad_mesh: triangles cover the sheet once, all wound alike", "[mesh]") {
  const int levels = GENERATE(0, 1, 2);
  CAPTURE(levels);
  const QuadMesh mesh = refined_sheet(3, 4, levels);
  double area = 0;
  std::map<std::pair<int, int>, int> directed_edges;
  for (const Triangle& t : mesh.triangles()) {
    const auto uv = [&](int k) { return Eigen::Vector2d(mesh.rest_coordinates().col(t[k])); };
    const Eigen::Vector2d a = uv(1) - uv(0);
    const Eigen::Vector2d b = uv(2) - uv(0);
    const double signed_area = 0.5 * (a.x() * b.y() - a.y() * b.x());
    CHECK(signed_area > 0);
    area += signed_area;
    for (int k = 0; k < 3; ++k) ++directed_edges[{t[k], t[(k + 1) % 3]}];
  }
  CHECK(area == Approx(0.8 * 1.3).epsilon(1e-12));
  for (const auto& [edge, count] : directed_edges) CHECK(count == 1);
}

TEST_CASE("quad_mesh: the triangles of a symmetric sheet are mirrored onto each other", "[mesh]") {
  const int levels = GENERATE(0, 1, 2);
  CAPTURE(levels);
  const QuadMesh mesh = refined_sheet(4, 4, levels);
  const auto key = [&](VertexId i, bool mirrored) {
    const Eigen::Vector2d uv = mesh.rest_coordinates().col(i);
    return std::pair(std::lround(uv.x() * 1e9),
                     std::lround((mirrored ? 0.8 - uv.y() : uv.y()) * 1e9));
  };
  std::set<std::set<std::pair<long, long>>> plain;
  std::set<std::set<std::pair<long, long>>> mirrored;
  for (const Triangle& t : mesh.triangles()) {
    plain.insert({key(t[0], false), key(t[1], false), key(t[2], false)});
    mirrored.insert({key(t[0], true), key(t[1], true), key(t[2], true)});
  }
  CHECK(plain == mirrored);
}

TEST_CASE("quad_mesh: vertex areas add up to the sheet and follow the corner rule", "[mesh]") {
  const QuadMesh mesh = refined_sheet(3, 4, 1);
  const Eigen::VectorXd areas = mesh.vertex_areas();
  CHECK(areas.sum() == Approx(0.8 * 1.3).epsilon(1e-12));
  const double cell = 0.8 * 1.3 / (6 * 8);
  CHECK(areas.maxCoeff() == Approx(cell).epsilon(1e-12));
  CHECK(areas[0] == Approx(cell / 4).epsilon(1e-12));
}

TEST_CASE("quad_mesh: a sheet of no size or with slanted threads is refused", "[mesh]") {
  SheetShape no_width;
  no_width.width = 0;
  CHECK_THROWS_AS(QuadMesh::sheet(no_width), ContractError);
  SheetShape no_rows;
  no_rows.rows = 0;
  CHECK_THROWS_AS(QuadMesh::sheet(no_rows), ContractError);
  SheetShape slanted;
  slanted.weft_direction = {1, 1, 0};
  CHECK_THROWS_AS(QuadMesh::sheet(slanted), ContractError);
  QuadMesh mesh = square_sheet(1);
  CHECK_THROWS_AS(mesh.refine_uniformly(-1), ContractError);
  CHECK_THROWS_AS(mesh.refine_uniformly(9), ContractError);
}

}  // namespace pleat
