#include "core/mesh/vertex_group.h"

#include <catch2/catch.hpp>

#include "core/mesh/triangle_mesh.h"
#include "native-tests/support/meshes.h"

namespace pleat {

TEST_CASE("vertex_group: a border of a sheet stays that border in every refinement", "[mesh]") {
  const int level = GENERATE(0, 1, 3);
  const int cells = 3;
  const TriangleMesh mesh = square_sheet(cells).triangle_mesh();
  VertexGroup border{"border", {}};
  const auto on_border = [](const Vec3& x) { return x.x() == 0; };
  for (int i = 0; i < mesh.n_vertices(); ++i)
    if (on_border(mesh.rest_positions.col(i))) border.vertices.emplace_back(i);
  std::vector<std::array<VertexId, 2>> middles;
  const TriangleMesh fine = subdivided(mesh, level, &middles);
  const VertexGroup carried = refined(border, mesh.n_vertices(), middles);
  std::vector<VertexId> expected;
  for (int i = 0; i < fine.n_vertices(); ++i)
    if (on_border(fine.rest_positions.col(i))) expected.emplace_back(i);
  CHECK(carried.vertices == expected);
  CHECK(carried.vertices.size() == static_cast<std::size_t>((cells << level) + 1));
  CHECK(carried.name == "border");
}

}  // namespace pleat
