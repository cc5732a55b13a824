#include "core/modal/key_faces.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "native-tests/support/bars.h"

using namespace pleat;

TEST_CASE("key_faces: a key may name the same triangles in any order", "[modal]") {
  std::vector<Triangle> other = box_triangles();
  std::reverse(other.begin(), other.end());
  for (Triangle& triangle : other)
    std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
  CHECK_NOTHROW(check_key_faces(8, box_triangles(), 8, other));
}

TEST_CASE("key_faces: another mesh is told by what differs", "[modal]") {
  using Catch::Matchers::Contains;
  const std::vector<Triangle> box = box_triangles();
  CHECK_THROWS_WITH(check_key_faces(8, box, 9, box), Contains("8 vertices") && Contains("found 9"));
  std::vector<Triangle> fewer = box;
  fewer.pop_back();
  CHECK_THROWS_WITH(check_key_faces(8, box, 8, fewer), Contains("12 triangles"));
  std::vector<Triangle> joined = box;
  joined[3] = {VertexId(0), VertexId(3), VertexId(5)};
  CHECK_THROWS_WITH(check_key_faces(8, box, 8, joined), Contains("vertices 1, 4 and 6"));
}
