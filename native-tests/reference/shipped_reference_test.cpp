#include <catch2/catch.hpp>

#include "core/model/elasticity.h"
#include "core/reference/reference_track.h"
#include "core/scene/scene_file.h"
#include "core/sweep/sweep_reference.h"
#include "native-tests/support/assets.h"

using namespace pleat;

namespace {

constexpr const char* kShipped[] = {"swinging_sheet", "curtain", "tablecloth"};

Scene shipped_scene(const std::string& name) {
  return read_scene(scene_text(name), fabric_library());
}

Reference shipped_reference(const std::string& name) {
  return read_reference(repository_file("assets/references/" + name + ".reference"));
}

}  // namespace

TEST_CASE("shipped references: they are of the scenes as they are shipped", "[reference]") {
  const std::string name = GENERATE(from_range(std::begin(kShipped), std::end(kShipped)));
  CAPTURE(name);
  const ReferenceTrack track(shipped_reference(name));
  CHECK(track.is_of(shipped_scene(name)));
  CHECK(track.end() == Approx(1.5));
  CHECK(track.label().converged);
}

TEST_CASE("shipped references: the laws of force are those that made them", "[reference]") {
  // Of the last sample, which is folded and stretched: another law of stretch, shear or bending, or
  // another constant in one of them, has another energy and other forces.
  struct Law {
    const char* name;
    double energy;  // [J]
    double force;   // norm over all vertices [N]
  };
  const Law law = GENERATE(Law{"swinging_sheet", 0.0136779669, 0.4141485644},
                           Law{"curtain", 0.003253782, 0.4714793315},
                           Law{"tablecloth", 0.0125953398, 1.3819623291});
  const Reference reference = shipped_reference(law.name);
  const Scene scene = shipped_scene(law.name);
  const ClothModel model = scene_model(scene, rest_cloth(scene, scene.level));
  const Positions& x = reference.samples.back().positions;
  Positions forces = Positions::Zero(3, x.cols());
  add_elastic_forces(model, x, forces);
  CAPTURE(law.name, elastic_energy(model, x), forces.norm());
  CHECK(elastic_energy(model, x) == Approx(law.energy).epsilon(1e-6));
  CHECK(forces.norm() == Approx(law.force).epsilon(1e-6));
}

TEST_CASE("shipped references: made anew, they begin the same", "[reference][long]") {
  const std::string name = GENERATE(from_range(std::begin(kShipped), std::end(kShipped)));
  CAPTURE(name);
  const Reference shipped = shipped_reference(name);
  ReferenceRecipe recipe{"anew", ReferenceKind::same_mesh, shipped_scene(name)};
  recipe.scene.method = exact_method(1.0 / 960);
  const std::vector<double> times{shipped.samples[0].time, shipped.samples[1].time};
  const auto maker = make_reference_maker(recipe, times);
  while (!maker->done()) maker->advance(1e6);
  const Reference anew = maker->reference();
  REQUIRE(anew.samples.size() == 2);
  for (std::size_t s = 0; s < 2; ++s) {
    const Positions difference = anew.samples[s].positions - shipped.samples[s].positions;
    // At twice the shipped step; both far closer to what they stand for than that.
    CHECK(difference.colwise().norm().maxCoeff() < 2e-4);
  }
}
