#include "core/reference/closed_form_reference.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/model/elasticity.h"
#include "core/reference/closed_forms.h"
#include "core/run/scene_model.h"
#include "core/scene/cloth/particle_cloth.h"
#include "core/scene/format/scene_file.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/cloth.h"
#include "native-tests/support/models.h"

using namespace pleat;

namespace {

const std::vector<double> kRestTimes = {1, 2.5};

std::vector<VertexId> first_vertices(int count) {
  std::vector<VertexId> vertices;
  vertices.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) vertices.emplace_back(i);
  return vertices;
}

/// A sheet without springs against shear, so that it hangs as a strip does.
Scene hanging_scene(int cells) {
  Scene scene = released_sheet_scene(cells, "spandex");
  change_cloth<SheetCloth>(scene, [](SheetCloth& sheet) { sheet.shape.width = 0.8; });
  scene.model.shear = false;
  scene.model.bending = BendingModel::none;
  return scene;
}

/// A strip of 0.3 m x 0.1 m that sticks out along z, its first two rows held.
Scene cantilever_scene(int rows) {
  SheetShape shape;
  shape.height = 0.3;
  shape.width = 0.1;
  shape.rows = rows;
  shape.columns = 2;
  shape.origin = {0, 1, 0};
  shape.warp_direction = {0, 0, 1};
  Scene scene;
  scene.cloth = SheetCloth(shape);
  scene.fabric = library_fabric("canvas");
  scene.pins = {{first_vertices(6), {}}};
  return scene;
}

/// Ten springs in no particular order between two pins.
Scene rope_scene() {
  ParticleCloth cloth;
  constexpr int kParticles = 11;
  cloth.positions = Positions::Zero(3, kParticles);
  cloth.positions.row(0).setLinSpaced(0, 0.9);
  cloth.positions.row(2).setLinSpaced(1, 1.4);
  cloth.velocities = Positions::Zero(3, kParticles);
  cloth.masses.setLinSpaced(kParticles, 0.01, 0.03);
  for (int i = kParticles - 2; i >= 0; --i)
    cloth.springs.push_back({VertexId(i + 1), VertexId(i), 40.0 + i, 0.12, 0, SpringKind::other});
  Scene scene;
  scene.cloth = std::move(cloth);
  scene.pins = {{std::vector<VertexId>{VertexId(0), VertexId(kParticles - 1)}, {}}};
  return scene;
}

/// Force that is left on free vertices, over the weight [1].
double imbalance(const Scene& scene, const Positions& positions) {
  const ClothModel model = scene_model(scene, rest_cloth(scene, scene.level));
  Positions forces = model.gravity * model.masses.transpose();
  add_elastic_forces(model, positions, forces);
  for (const Pin& pin : model.pins) forces.col(pin.vertex).setZero();
  return forces.norm() / (model.masses.sum() * model.gravity.norm());
}

const Positions& rest_positions(const Reference& reference) {
  return reference.samples.back().positions;
}

}  // namespace

TEST_CASE("closed_form_reference: a hanging sheet of springs is in balance", "[reference]") {
  Scene scene = hanging_scene(5);
  scene.level = GENERATE(0, 1);
  SECTION("held by its edge, released from the horizontal") {}
  SECTION("held by three rows, straight down") {
    change_cloth<SheetCloth>(scene, [](SheetCloth& sheet) {
      sheet.shape.warp_direction = {0, -1, 0};
    });
    scene.level = 0;
    scene.pins = {{first_vertices(18), {}}};
  }
  SECTION("without shear stiffness") {
    scene.model.shear = true;
    scene.fabric.shear = 0;
  }
  const Reference reference = closed_form_reference(scene, kRestTimes);
  REQUIRE(reference.samples.size() == 2);
  CHECK(reference.label.converged);
  CHECK(reference.samples.front().time == 1);
  CHECK(reference.samples.front().stretch.largest > 1e-4);
  CHECK(imbalance(scene, rest_positions(reference)) < 1e-10);
}

TEST_CASE("closed_form_reference: a chain is in balance, whatever the order of its springs",
          "[reference]") {
  Scene scene = rope_scene();
  SECTION("between two supports") {}
  SECTION("below one") { scene.pins = {{std::vector<VertexId>{VertexId(10)}, {}}}; }
  SECTION("under a weight that points elsewhere") { scene.gravity = {1, -3, 2}; }
  const Reference reference = closed_form_reference(scene, kRestTimes);
  CHECK(imbalance(scene, rest_positions(reference)) < 1e-9);
}

TEST_CASE("closed_form_reference: the chain that comes with the program hangs in balance",
          "[reference]") {
  const Scene scene = read_scene(scene_text("hanging_chain"), fabric_library());
  CHECK(imbalance(scene, rest_positions(closed_form_reference(scene, kRestTimes))) < 1e-12);
}

TEST_CASE("closed_form_reference: a strip held by two rows is an elastica from between them",
          "[reference]") {
  const Scene scene = cantilever_scene(12);
  const Reference reference = closed_form_reference(scene, kRestTimes);
  const Positions& x = rest_positions(reference);
  const double row = 0.3 / 12;
  const Cantilever strip{0.3 - row / 2, scene.fabric.areal_density * 9.81, scene.fabric.bend_warp};
  const double tip[] = {strip.length};
  const Eigen::Vector2d place = heavy_elastica(strip, tip).col(0);
  CHECK(x.col(x.cols() - 1).isApprox(Vec3(0.1, 1 - place.y(), row / 2 + place.x()), 1e-12));
  CHECK(x.leftCols(6).isApprox(rest_cloth(scene, scene.level).quads->rest_positions().leftCols(6)));
}

TEST_CASE("closed_form_reference: a static shape does not depend on the method", "[reference]") {
  Scene scene = hanging_scene(3);
  const std::string id = closed_form_reference(scene, kRestTimes).label.id;
  scene.method.stepper = &steppers::kXpbd;
  CHECK(closed_form_reference(scene, kRestTimes).label.id == id);
  scene.fabric.areal_density *= 1.01;
  CHECK(closed_form_reference(scene, kRestTimes).label.id != id);
}

TEST_CASE("closed_form_reference: scenes without a closed form are refused by what they lack",
          "[reference]") {
  const auto where = [](const Scene& scene) -> std::string {
    try {
      closed_form_reference(scene, kRestTimes);
    } catch (const InputError& error) {
      return error.where();
    }
    return "accepted";
  };
  Scene sheet = hanging_scene(3);
  Scene strip = cantilever_scene(6);
  Scene rope = rope_scene();
  SECTION("air") {
    sheet.air.emplace();
    CHECK(where(sheet) == "/world/air");
  }
  SECTION("a solid") {
    sheet.colliders.emplace_back();
    CHECK(where(sheet) == "/world/colliders");
  }
  SECTION("no weight") {
    rope.gravity.setZero();
    CHECK(where(rope) == "/world/gravity_m_per_s2");
  }
  SECTION("a moving edge") {
    sheet.pins.front().motion.kind = Motion::Kind::move;
    CHECK(where(sheet) == "/pins");
  }
  SECTION("half a row more") {
    sheet.pins.push_back({std::vector<VertexId>{VertexId(4), VertexId(5)}, {}});
    CHECK(where(sheet) == "/pins");
  }
  SECTION("a row that is not the next") {
    sheet.pins.push_back({"lower_edge", {}});
    CHECK(where(sheet) == "/pins");
  }
  SECTION("all rows") {
    sheet.pins = {{first_vertices(16), {}}};
    CHECK(where(sheet) == "/pins");
  }
  SECTION("no pins") {
    sheet.pins.clear();
    CHECK(where(sheet) == "/pins");
  }
  SECTION("sides that draw in") {
    sheet.model.shear = true;
    CHECK(where(sheet) == "/model/shear");
  }
  SECTION("weft not level") {
    sheet.gravity = {1, -9, 0};
    CHECK(where(sheet) == "/cloth/sheet/weft_direction");
  }
  SECTION("a slanting clamp") {
    strip.gravity = {0, -9, 1};
    CHECK(where(strip) == "/cloth/sheet/warp_direction");
  }
  SECTION("a limp strip") {
    strip.model.bending = BendingModel::none;
    CHECK(where(strip) == "/model/bending");
  }
  SECTION("a strip without rigidity") {
    strip.fabric.bend_warp = 0;
    CHECK(where(strip) == "/fabric/bend_warp_n_m");
  }
  SECTION("a strip with hardly any rigidity") {
    strip.fabric.bend_warp = 1e-9;
    CHECK(where(strip) == "/fabric/bend_warp_n_m");
  }
  SECTION("a rope held inside") {
    rope.pins = {{std::vector<VertexId>{VertexId(0), VertexId(4)}, {}}};
    CHECK(where(rope) == "/pins");
  }
  SECTION("a rope held inside alone") {
    rope.pins = {{std::vector<VertexId>{VertexId(4)}, {}}};
    CHECK(where(rope) == "/cloth/particles/springs");
  }
  SECTION("a ring") {
    change_cloth<ParticleCloth>(rope, [](ParticleCloth& cloth) {
      cloth.springs.push_back({VertexId(0), VertexId(10), 1, 1, 0, SpringKind::other});
    });
    CHECK(where(rope) == "/cloth/particles/springs");
  }
  SECTION("a fork") {
    change_cloth<ParticleCloth>(
        rope, [](ParticleCloth& cloth) { cloth.springs.front().b = VertexId(8); });
    CHECK(where(rope) == "/cloth/particles/springs");
  }
  SECTION("a spring without stiffness") {
    change_cloth<ParticleCloth>(rope,
                                [](ParticleCloth& cloth) { cloth.springs.front().stiffness = 0; });
    CHECK(where(rope) == "/cloth/particles/springs");
  }
  SECTION("a rope with rigidity") {
    change_cloth<ParticleCloth>(rope, [](ParticleCloth& cloth) {
      cloth.bends.push_back({{VertexId(0), VertexId(1), VertexId(2)}, {1, -2, 1}, 1});
    });
    CHECK(where(rope) == "/cloth/particles/bends");
  }
  SECTION("supports above each other") {
    change_cloth<ParticleCloth>(
        rope, [](ParticleCloth& cloth) { cloth.positions.col(10) = Vec3(0, 2, 1); });
    CHECK(where(rope) == "/pins");
  }
}
