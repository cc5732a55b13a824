#include "core/run/scene_model.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/run/simulation.h"
#include "core/scene/tearing.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

const std::vector<std::string> kOnRequest = {
    "gravity", "pins", "air drag", "wind", "contact", "strain limit", "tearing", "inner friction"};

BuildReport report_of(const Scene& scene) {
  const Simulation simulation(scene);
  return build_report(simulation.model(), scene.model);
}

bool has(const std::vector<std::string>& parts, const std::string& part) {
  return std::find(parts.begin(), parts.end(), part) != parts.end();
}

TEST_CASE("scene_model: what a scene does not ask for is not built", "[run]") {
  Scene scene = released_sheet_scene(4, "fine cotton");
  scene.gravity.setZero();
  scene.pins.clear();
  const BuildReport report = report_of(scene);
  CHECK(report.bytes.size() == report.built.size());
  for (const std::string& part : kOnRequest) {
    INFO(part);
    CHECK(has(report.left_out, part));
    CHECK_FALSE(has(report.built, part));
  }
}

TEST_CASE("scene_model: what a scene asks for is built", "[run]") {
  Scene scene = released_sheet_scene(4, "fine cotton");
  scene.cloth = SheetCloth(SheetShape{1, 1, 4, 4});
  scene.air = AirOptions{};
  scene.air->wind.velocity = {1, 0, 0};
  scene.colliders.push_back({Plane{}, {}, 0.3});
  scene.model.strain_limit = StrainLimitOptions{};
  scene.fabric.bend_hysteresis = 1e-3;
  auto tearing = std::make_shared<Tearing>();
  tearing->breaking_elongation = 1;
  scene.model.tearing = tearing;
  const BuildReport report = report_of(scene);
  for (const std::string& part : kOnRequest) {
    INFO(part);
    CHECK(has(report.built, part));
    CHECK_FALSE(has(report.left_out, part));
  }
}

}  // namespace
}  // namespace pleat
