#include "core/scene/rest_cloth.h"

#include <catch2/catch.hpp>

using namespace pleat;

TEST_CASE("rest_cloth: a sheet's rest diagonal does not depend on how it lies", "[scene]") {
  Scene scene;
  auto& shape = std::get<SheetShape>(scene.cloth);
  shape.width = 0.3;
  shape.height = 0.4;
  shape.warp_direction = Vec3(0, -1, 1).normalized();
  CHECK(rest_diagonal(scene) == Approx(0.5).epsilon(1e-15));
}
