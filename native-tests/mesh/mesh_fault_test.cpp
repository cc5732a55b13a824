#include "core/mesh/mesh_fault.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

VertexId vertex(int i) { return VertexId(i); }

/// Five vertices, no three on a line.
Positions five() {
  Positions x(3, 5);
  x << 0, 1, 0, 1, 0,  //
      0, 0, 1, 1, 0,   //
      0, 0, 0, 1, 1;
  return x;
}

}  // namespace

TEST_CASE("mesh_fault: a sheet at any size is sound, and so is a closed box", "[mesh]") {
  const double size = GENERATE(1e-8, 1.0, 1e8);
  const TriangleMesh mesh = square_sheet(4).triangle_mesh();
  CHECK_FALSE(mesh_fault(size * mesh.rest_positions, mesh.triangles, 0));
  const std::vector<Triangle> closed{{vertex(0), vertex(2), vertex(1)},
                                     {vertex(0), vertex(1), vertex(3)},
                                     {vertex(1), vertex(2), vertex(3)},
                                     {vertex(2), vertex(0), vertex(3)}};
  CHECK_FALSE(mesh_fault(size * five().leftCols(4), closed, 0));
}

TEST_CASE("mesh_fault: the first fault is told with its place", "[mesh]") {
  struct Case {
    std::vector<Triangle> triangles;
    int triangle, vertex;  // -1 for none
    std::string sentence;
  };
  const std::vector<Case> cases = {
      {{{vertex(0), vertex(1), vertex(2)},
        {vertex(1), vertex(0), vertex(3)},
        {vertex(0), vertex(1), vertex(4)}},
       2,
       -1,
       "expected at most two triangles at an edge, got a third at that from vertex 1 to 2"},
      {{{vertex(0), vertex(1), vertex(2)},
        {vertex(0), vertex(1), vertex(3)},
        {vertex(2), vertex(1), vertex(4)}},
       1,
       -1,
       "expected neighbours wound alike, got two triangles that both go from vertex 1 to 2"},
      {{{vertex(0), vertex(1), vertex(2)},
        {vertex(2), vertex(1), vertex(0)},
        {vertex(2), vertex(1), vertex(4)}},
       1,
       -1,
       "expected each triangle once, got two with the vertices 2, 1 and 3"},
      {{{vertex(0), vertex(1), vertex(2)}, {vertex(2), vertex(1), vertex(4)}},
       -1,
       3,
       "expected every vertex in a triangle, got vertex 4 in none"},
      {{{vertex(0), vertex(1), vertex(2)}, {vertex(3), vertex(4), vertex(3)}},
       1,
       -1,
       "expected a triangle with an area, got the vertices 4, 5 and 4 on a line"},
  };
  for (const Case& c : cases) {
    CAPTURE(c.sentence);
    const auto fault = mesh_fault(five(), c.triangles, 1);
    REQUIRE(fault);
    CHECK(fault->sentence == c.sentence);
    CHECK(fault->triangle == c.triangle);
    CHECK(fault->vertex == c.vertex);
  }
}

TEST_CASE("mesh_fault: a band is sound with a whole turn or none, a Moebius band is not",
          "[mesh]") {
  const bool half_turn = GENERATE(false, true);
  constexpr int kQuads = 12;
  Positions x(3, 2 * kQuads);
  std::vector<Triangle> triangles;
  for (int i = 0; i < kQuads; ++i) {
    const double angle = 2 * M_PI * i / kQuads;
    const double tilt = half_turn ? angle / 2 : 0;
    for (const int side : {0, 1}) {
      const double across = side == 0 ? -0.2 : 0.2;
      x.col(2 * i + side) << (1 + across * std::cos(tilt)) * std::cos(angle),
          (1 + across * std::cos(tilt)) * std::sin(angle), across * std::sin(tilt);
    }
    const bool swaps = half_turn && i == kQuads - 1;
    const int next = (2 * i + 2) % (2 * kQuads);
    const int near_low = 2 * i, near_high = 2 * i + 1;
    const int far_low = swaps ? next + 1 : next, far_high = swaps ? next : next + 1;
    triangles.push_back({vertex(near_low), vertex(far_low), vertex(near_high)});
    triangles.push_back({vertex(far_low), vertex(far_high), vertex(near_high)});
  }
  CHECK(mesh_fault(x, triangles, 0).has_value() == half_turn);
}

TEST_CASE("mesh_fault: a triangle slimmer than a millionth has no area", "[mesh]") {
  Positions x(3, 3);
  x << 0, 1, 0.5, 0, 0, 0, 0, 0, 0;
  const std::vector<Triangle> one{{vertex(0), vertex(1), vertex(2)}};
  x(2, 2) = 1.1e-6;
  CHECK_FALSE(mesh_fault(x, one, 0));
  x(2, 2) = 0.9e-6;
  CHECK(mesh_fault(x, one, 0));
}

}  // namespace pleat
