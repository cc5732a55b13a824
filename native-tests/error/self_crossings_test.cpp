#include "core/error/self_crossings.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <set>

#include "core/base/check.h"
#include "core/model/hanging_vertices.h"
#include "native-tests/support/graded_sheets.h"

using namespace pleat;

namespace {

using Edge = std::pair<int, int>;

struct Cloth {
  std::vector<Triangle> triangles;
  Positions positions;
  std::vector<HangingVertex> hanging;

  std::int64_t crossings() const { return self_crossings(triangles, positions, hanging); }
};

Cloth cloth_of(const QuadMesh& mesh) {
  return {mesh.triangles(), mesh.rest_positions(), mesh.hanging_vertices()};
}

/// Vertices anywhere in a cube of 1 m.
Cloth crumpled(const QuadMesh& mesh, Random& random) {
  Cloth cloth = cloth_of(mesh);
  for (double& x : cloth.positions.reshaped()) x = random.uniform(0, 1);
  place_between_parents(cloth.hanging, cloth.positions);
  return cloth;
}

/// Each vertex with those that it hangs between.
std::set<int> with_parents(const Cloth& cloth, std::set<int> vertices) {
  for (const HangingVertex& h : cloth.hanging)
    if (vertices.count(h.vertex) > 0)
      for (const VertexId parent : h.parents) vertices.insert(parent);
  return vertices;
}

/// a + s (b - a) = c0 + u (c1 - c0) + v (c2 - c0), solved as it stands.
bool meet_inside(const Cloth& cloth, const Edge& edge, const Triangle& t) {
  const auto x = [&](int v) { return Vec3(cloth.positions.col(v)); };
  Mat3 columns;
  columns << x(edge.second) - x(edge.first), x(t[0]) - x(t[1]), x(t[0]) - x(t[2]);
  const Vec3 shares = columns.inverse() * (x(t[0]) - x(edge.first));
  return shares.minCoeff() > 0 && shares[0] < 1 && shares[1] + shares[2] < 1;
}

/// Every edge against every triangle.
std::int64_t by_force(const Cloth& cloth) {
  std::set<Edge> edges;
  for (const Triangle& t : cloth.triangles)
    for (int k = 0; k < 3; ++k) edges.insert(std::minmax<int>(t[k].value, t[(k + 1) % 3].value));
  for (const HangingVertex& h : cloth.hanging)
    edges.erase(std::minmax<int>(h.parents[0].value, h.parents[1].value));
  std::int64_t n = 0;
  for (const Edge& edge : edges) {
    const std::set<int> of_edge = with_parents(cloth, {edge.first, edge.second});
    for (const Triangle& t : cloth.triangles) {
      bool share = false;
      for (const int v : with_parents(cloth, {t[0], t[1], t[2]})) {
        const bool is_corner = v == t[0] || v == t[1] || v == t[2];
        const bool is_end = v == edge.first || v == edge.second;
        share = share || (of_edge.count(v) > 0 && (is_corner || is_end));
      }
      if (!share && meet_inside(cloth, edge, t)) ++n;
    }
  }
  return n;
}

/// The second cloth's vertices after the first's.
Cloth together(const Cloth& a, const Cloth& b) {
  Cloth both = a;
  const auto n = static_cast<int>(a.positions.cols());
  both.positions.conservativeResize(3, n + b.positions.cols());
  both.positions.rightCols(b.positions.cols()) = b.positions;
  for (Triangle t : b.triangles) {
    for (VertexId& v : t) v = VertexId(v + n);
    both.triangles.push_back(t);
  }
  return both;
}

/// Columns x rows cells from (x, y) = `corner`, upright in the plane y = corner.y, z from -1 to 1.
Cloth upright(int columns, int rows, const Eigen::Vector2d& corner, double width) {
  SheetShape shape;
  shape.columns = columns;
  shape.rows = rows;
  shape.width = width;
  shape.height = 2;
  shape.origin = {corner.x(), corner.y(), 1};
  shape.warp_direction = {0, 0, -1};
  shape.weft_direction = {1, 0, 0};
  return cloth_of(QuadMesh::sheet(shape));
}

}  // namespace

TEST_CASE("self_crossings: crumpled cloth crosses itself as often as all pairs tell", "[error]") {
  Random random(GENERATE(1, 2, 3, 4));
  const Cloth uniform = crumpled(square_sheet(6), random);
  CHECK(uniform.crossings() == by_force(uniform));
  CHECK(uniform.crossings() > 100);
  const Cloth graded = crumpled(graded_sheet(random.below(100)), random);
  REQUIRE(graded.hanging.size() > 3);
  CHECK(graded.crossings() == by_force(graded));
}

TEST_CASE("self_crossings: a counter follows cloth away from where it was made", "[error]") {
  Random random(5);
  const QuadMesh mesh = square_sheet(6);
  SelfCrossings counter(mesh.triangles(), mesh.rest_positions());
  for (int n = 0; n < 3; ++n) {
    const Cloth cloth = crumpled(mesh, random);
    CHECK(counter.count(cloth.positions) == by_force(cloth));
  }
  CHECK(counter.count(mesh.rest_positions()) == 0);
}

// The upright sheet has an odd number of rows: at z = 0 every column's line and one diagonal of
// every cell between go through the lying one. Of that only the diagonal meets the upright sheet.
TEST_CASE("self_crossings: two sheets cross in each edge that passes the other", "[error]") {
  const int columns = GENERATE(1, 4);
  const int rows = GENERATE(1, 3, 7);
  CAPTURE(columns, rows);
  const Cloth both = together(cloth_of(lying_sheet(1)), upright(columns, rows, {0.2, 0.37}, 0.55));
  CHECK(both.crossings() == 2 * columns + 1 + 1);
}

TEST_CASE("self_crossings: the count does not depend on scale", "[error]") {
  Random random(6);
  Cloth cloth = crumpled(square_sheet(6), random);
  const std::int64_t n = cloth.crossings();
  cloth.positions *= GENERATE(1e-8, 1e8);
  CHECK(cloth.crossings() == n);
}

TEST_CASE("self_crossings: cloth that touches itself does not cross", "[error]") {
  Cloth flat = cloth_of(graded_sheet(GENERATE(1, 2, 3, 4, 5)));
  REQUIRE(!flat.hanging.empty());
  const Eigen::AngleAxisd turn(1, Vec3(1, 2, 3).normalized());
  flat.positions = turn.toRotationMatrix() * flat.positions;
  place_between_parents(flat.hanging, flat.positions);
  CHECK(flat.crossings() == 0);

  Cloth folded = cloth_of(lying_sheet(GENERATE(8, 60)));
  folded.positions.row(0) = (folded.positions.row(0).array() - 0.5).abs();
  folded.positions = turn.toRotationMatrix() * folded.positions;
  CHECK(folded.crossings() == 0);

  Cloth standing = upright(3, 3, {0.2, 0.37}, 0.55);
  standing.positions.row(2).array() += 1;
  CHECK(together(cloth_of(lying_sheet(1)), standing).crossings() == 0);
}

TEST_CASE("self_crossings: no triangles, no crossings, and no count of what is not finite",
          "[error]") {
  CHECK(self_crossings({}, Positions::Zero(3, 2)) == 0);
  Cloth cloth = cloth_of(square_sheet(2));
  cloth.positions(1, 3) = std::nan("");
  CHECK_THROWS_AS(cloth.crossings(), ContractError);
}
