#include "core/scene/rest_cloth.h"

#include <catch2/catch.hpp>

using namespace pleat;

TEST_CASE("rest_cloth: a sheet's rest diagonal does not depend on how it lies", "[scene]") {
  Scene scene;
  SheetShape shape;
  shape.width = 0.3;
  shape.height = 0.4;
  shape.warp_direction = Vec3(0, -1, 1).normalized();
  scene.cloth = SheetCloth(shape);
  CHECK(scene.cloth->rest_diagonal() == Approx(0.5).epsilon(1e-15));
}
