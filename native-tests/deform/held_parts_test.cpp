#include "core/deform/held_parts.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

/// Two squares of 3 x 3 vertices, vertices 0 to 8 and 9 to 17, 5 m apart.
TriangleMesh two_squares() {
  TriangleMesh mesh = square_sheet(2).triangle_mesh();
  const TriangleMesh first = mesh;
  mesh.rest_positions.conservativeResize(3, 18);
  mesh.rest_positions.rightCols(9) = first.rest_positions.colwise() + Vec3(5, 0, 0);
  for (const Triangle& t : first.triangles)
    mesh.triangles.push_back({VertexId(t[0] + 9), VertexId(t[1] + 9), VertexId(t[2] + 9)});
  return mesh;
}

std::vector<Hold> holds(const TriangleMesh& mesh, const std::vector<VertexId>& held,
                        const Positions& targets) {
  std::vector<Hold> found;
  for (const HeldPart& part : held_parts(mesh, held, targets)) found.push_back(part.hold);
  return found;
}

/// Held where they rest.
std::vector<Hold> holds_at_rest(const TriangleMesh& mesh, const std::vector<int>& held) {
  std::vector<VertexId> vertices;
  Positions targets(3, static_cast<Eigen::Index>(held.size()));
  for (const int v : held) {
    targets.col(static_cast<Eigen::Index>(vertices.size())) = mesh.rest_positions.col(v);
    vertices.emplace_back(v);
  }
  return holds(mesh, vertices, targets);
}

}  // namespace

TEST_CASE("held parts: a part is what hangs together by edges", "[deform]") {
  const std::vector<HeldPart> parts = held_parts(two_squares(), {}, Positions(3, 0));
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].first == 0);
  CHECK(parts[1].first == 9);
  CHECK(parts[0].n_vertices == 9);
  CHECK(parts[1].n_vertices == 9);
  // Two triangles that share one corner.
  TriangleMesh bow{
      Positions(3, 5),
      {{VertexId(0), VertexId(1), VertexId(2)}, {VertexId(2), VertexId(3), VertexId(4)}},
      {}};
  bow.rest_positions << 0, 0, 1, 2, 2, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0;
  const std::vector<HeldPart> touching = held_parts(bow, {}, Positions(3, 0));
  REQUIRE(touching.size() == 2);
  CHECK(touching[1].first == 2);
  CHECK(touching[0].n_vertices + touching[1].n_vertices == 6);
  // The shared corner is held for both.
  CHECK(holds_at_rest(bow, {0, 1, 2}) == std::vector<Hold>{Hold::firm, Hold::point});
}

TEST_CASE("held parts: three places off a line hold a part, and only that part", "[deform]") {
  const TriangleMesh mesh = two_squares();
  CHECK(holds_at_rest(mesh, {}) == std::vector<Hold>{Hold::none, Hold::none});
  CHECK(holds_at_rest(mesh, {4}) == std::vector<Hold>{Hold::point, Hold::none});
  CHECK(holds_at_rest(mesh, {17, 9}) == std::vector<Hold>{Hold::none, Hold::line});
  CHECK(holds_at_rest(mesh, {0, 4, 8, 9}) == std::vector<Hold>{Hold::line, Hold::point});
  CHECK(holds_at_rest(mesh, {0, 4, 7}) == std::vector<Hold>{Hold::firm, Hold::none});
  CHECK(holds_at_rest(mesh, {9, 1, 0, 17, 3, 11}) == std::vector<Hold>{Hold::firm, Hold::firm});
}

TEST_CASE("held parts: what counts is where vertices are held, at any scale", "[deform]") {
  const double scale = GENERATE(1e-4, 1.0, 1e6);
  CAPTURE(scale);
  const TriangleMesh mesh = square_sheet(2).triangle_mesh();
  const std::vector<VertexId> corners{VertexId(0), VertexId(2), VertexId(6)};
  Positions line(3, 3);
  line << 0, 1, 2, 3, 4, 5, 1, 1, 1;
  line *= scale;
  CHECK(holds(mesh, corners, line) == std::vector<Hold>{Hold::line});
  Positions bent = line;
  bent(2, 1) += 1e-3 * scale;
  CHECK(holds(mesh, corners, bent) == std::vector<Hold>{Hold::firm});
  const Positions point = line.col(1).replicate<1, 3>();
  CHECK(holds(mesh, corners, point) == std::vector<Hold>{Hold::point});
  // These lie on a line at rest, but not where they are held.
  const std::vector<VertexId> edge{VertexId(0), VertexId(1), VertexId(2)};
  CHECK(holds(mesh, edge, bent) == std::vector<Hold>{Hold::firm});
}

TEST_CASE("held parts: cloth far from the origin is held as it would be there", "[deform]") {
  const double far = GENERATE(1e6, 1e8, -1e10);  // [m]
  CAPTURE(far);
  TriangleMesh mesh = two_squares();
  mesh.rest_positions.colwise() += Vec3(far, far / 3, 0.7 * far);
  CHECK(holds_at_rest(mesh, {0, 4, 7, 9}) == std::vector<Hold>{Hold::firm, Hold::point});
  CHECK(holds_at_rest(mesh, {0, 4, 8}) == std::vector<Hold>{Hold::line, Hold::none});
}

TEST_CASE("held parts: a held vertex without a place is a fault of the program", "[deform]") {
  CHECK_THROWS_AS(held_parts(two_squares(), {VertexId(0)}, Positions(3, 0)), ContractError);
}

}  // namespace pleat
