#include "core/reference/chain_reference.h"

#include <catch2/catch.hpp>
#include <limits>

#include "core/base/check.h"
#include "core/error/error_norms.h"
#include "core/scene/cloth/particle_cloth.h"
#include "native-tests/support/cloth.h"
#include "native-tests/support/models.h"

using namespace pleat;

namespace {

const std::vector<double> kTimes = {0.25, 0.5, 0.75, 1};

Scene swinging_scene(int cells) { return released_sheet_scene(cells, "fine cotton"); }

}  // namespace

TEST_CASE("chain_reference: the rows of the sheet stay level and keep their distance",
          "[reference]") {
  Scene scene = swinging_scene(4);
  scene.level = 1;
  const Reference reference = chain_reference(scene, kTimes);
  CHECK(reference.label.converged);
  const QuadMesh mesh = [&] {
    QuadMesh sheet = QuadMesh::sheet(scene.cloth.as<SheetCloth>()->shape);
    sheet.refine_uniformly(1);
    return sheet;
  }();
  REQUIRE(reference.samples.size() == kTimes.size());
  for (const Sample& sample : reference.samples) {
    for (int i = 0; i < mesh.n_vertices(); ++i) {
      for (int j = 0; j < mesh.n_vertices(); ++j) {
        const Eigen::Vector2d apart =
            mesh.rest_coordinates().col(i) - mesh.rest_coordinates().col(j);
        const Vec3 found = sample.positions.col(i) - sample.positions.col(j);
        if (apart.x() == 0) CHECK(found.norm() == Approx(std::abs(apart.y())).margin(1e-12));
        if (apart.y() == 0 && std::abs(apart.x()) < 0.13)
          CHECK(found.norm() == Approx(std::abs(apart.x())).margin(1e-12));
      }
    }
  }
}

// Bending is left out, as the chain has none: its tip whips round when it has come up on the other
// side, where the rigidity of fine cotton moves the sheet by centimetres. What is left is stretch,
// 0.01 % rms.
TEST_CASE("chain_reference: fine cotton swings as a chain of rigid links, within 2 mm",
          "[reference][long]") {
  Scene scene = swinging_scene(GENERATE(8, 16));
  scene.model.bending = BendingModel::none;
  scene.method.stepper = &steppers::kExplicitEuler;
  scene.method.substeps = 0;
  const Reference reference = chain_reference(scene, kTimes);
  SampledRun run(scene, kTimes, SampledRun::Parts::untimed);
  run.advance(std::numeric_limits<double>::infinity());
  REQUIRE(run.report().ok());
  for (std::size_t s = 0; s < kTimes.size(); ++s) {
    CAPTURE(kTimes[s]);
    const Eigen::VectorXd areas = run.simulation().mesh()->vertex_areas();
    CHECK(position_error(run.samples()[s].positions, reference.samples[s].positions, areas) < 2e-3);
  }
}

TEST_CASE("chain_reference: scenes that do not swing so are refused", "[reference]") {
  Scene scene = swinging_scene(2);
  SECTION("air") { scene.air.emplace(); }
  SECTION("a solid") { scene.colliders.emplace_back(); }
  SECTION("no pins") { scene.pins.clear(); }
  SECTION("a moving edge") { scene.pins.front().motion.kind = Motion::Kind::move; }
  SECTION("another edge") { scene.pins.front().where = "left_edge"; }
  SECTION("thrown") {
    change_cloth<SheetCloth>(scene, [](SheetCloth& sheet) { sheet.initial_velocity = {0, 0, 1}; });
  }
  SECTION("weft not level") { scene.gravity = Vec3(1, -9, 0); }
  SECTION("particles") { scene.cloth = ParticleCloth{}; }
  CHECK_THROWS_AS(chain_reference(scene, kTimes), InputError);
}
