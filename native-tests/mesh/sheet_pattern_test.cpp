#include "core/mesh/sheet_pattern.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/mesh/mesh_fault.h"

namespace pleat {
namespace {

SheetShape shape_of(int columns, int rows) {
  SheetShape shape;
  shape.width = 0.7;
  shape.height = 0.4;
  shape.columns = columns;
  shape.rows = rows;
  shape.origin = {1, 2, 3};
  shape.warp_direction = Vec3::UnitZ();
  shape.weft_direction = Vec3::UnitX();
  return shape;
}

double side(const TriangleMesh& mesh, const Triangle& t, std::size_t k) {
  return (mesh.rest_positions.col(t[k]) - mesh.rest_positions.col(t[(k + 1) % 3])).norm();
}

}  // namespace

TEST_CASE("sheet pattern: triangles cover the sheet once, wound like its cells", "[mesh]") {
  const SheetPattern pattern = GENERATE(SheetPattern::one_way, SheetPattern::alternating,
                                        SheetPattern::crossed, SheetPattern::equilateral);
  const int rows = GENERATE(1, 2, 5);
  const int columns = GENERATE(1, 4);
  CAPTURE(static_cast<int>(pattern), rows, columns);
  const SheetShape shape = shape_of(columns, rows);
  const TriangleMesh mesh = patterned_sheet(shape, pattern);
  CHECK(mesh.n_vertices() == n_patterned_vertices(shape, pattern));
  CHECK_FALSE(mesh_fault(mesh.rest_positions, mesh.triangles, 0));
  double area = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 doubled =
        (mesh.rest_positions.col(t[1]) - mesh.rest_positions.col(t[0]))
            .cross(Vec3(mesh.rest_positions.col(t[2]) - mesh.rest_positions.col(t[0])));
    CHECK(doubled.y() > 0);
    area += doubled.y() / 2;
  }
  CHECK(area == Approx(shape.width * shape.height));
  CHECK(mesh.rest_positions.rowwise().minCoeff().isApprox(Vec3(1, 2, 3)));
  CHECK(mesh.rest_positions.rowwise().maxCoeff().isApprox(Vec3(1.7, 2, 3.4)));
  CHECK(mesh.warp_directions == std::vector<Vec3>(mesh.triangles.size(), Vec3::UnitZ()));
  // A disc: without holes or parts of its own.
  const auto n_edges = static_cast<int>(mesh_edges(mesh.triangles).size());
  CHECK(mesh.n_vertices() - n_edges + static_cast<int>(mesh.triangles.size()) == 1);
}

TEST_CASE("sheet pattern: diagonals run one way, in turn, or both ways", "[mesh]") {
  const SheetShape shape = shape_of(2, 1);
  const auto n_at = [&](SheetPattern pattern, int vertex) {
    int n = 0;
    for (const Triangle& t : patterned_sheet(shape, pattern).triangles)
      for (const VertexId v : t) n += v == vertex ? 1 : 0;
    return n;
  };
  // The middle of the upper edge: one_way has one diagonal there, alternating two or none.
  CHECK(n_at(SheetPattern::one_way, 1) == 3);
  CHECK(n_at(SheetPattern::alternating, 1) + n_at(SheetPattern::alternating, 4) == 6);
  CHECK(std::abs(n_at(SheetPattern::alternating, 1) - n_at(SheetPattern::alternating, 4)) == 2);
  CHECK(n_at(SheetPattern::crossed, 1) == 4);
}

TEST_CASE("sheet pattern: cells of the right height make equilateral triangles", "[mesh]") {
  SheetShape shape = shape_of(6, 4);
  const double edge = shape.width / 6;
  shape.height = 4 * std::sqrt(0.75) * edge;
  const TriangleMesh mesh = patterned_sheet(shape, SheetPattern::equilateral);
  int n_equilateral = 0;
  for (const Triangle& t : mesh.triangles) {
    bool is_equilateral = true;
    for (std::size_t k = 0; k < 3; ++k) is_equilateral &= std::abs(side(mesh, t, k) - edge) < 1e-12;
    n_equilateral += is_equilateral ? 1 : 0;
  }
  CHECK(mesh.triangles.size() == 4 * 13);
  CHECK(n_equilateral == 4 * 11);  // all but the halves at both ends of a row
}

TEST_CASE("sheet pattern: a sheet without cells is refused", "[mesh]") {
  CHECK_THROWS_AS(patterned_sheet(shape_of(0, 1), SheetPattern::crossed), ContractError);
  CHECK_THROWS_AS(patterned_sheet(shape_of(1, 0), SheetPattern::equilateral), ContractError);
}

}  // namespace pleat
