#include "core/run/response_study.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/dynamics/stepper_table.h"
#include "native-tests/support/models.h"
#include "native-tests/support/particle.h"

namespace pleat {
namespace {

/// A small sheet that falls on a ball, askew and beside its middle, or has no time to.
Scene dropped_scene(double duration = 0.4) {
  Scene scene = released_sheet_scene(6, "fine cotton");
  scene.pins.clear();
  SheetCloth sheet = *scene.cloth.as<SheetCloth>();
  const Vec3 middle = sheet.shape.origin + sheet.shape.height / 2 * sheet.shape.warp_direction +
                      sheet.shape.width / 2 * sheet.shape.weft_direction;
  scene.colliders = {ball_collider(middle - Vec3(0.1, 0.45, 0.05), 0.4, 0.3)};
  sheet.initial_velocity = {0.3, 0, 0.2};
  scene.cloth = sheet;
  scene.method = steppers::kExplicitEuler.usual_method();
  scene.duration = duration;
  return scene;
}

}  // namespace

TEST_CASE("response_study: cloth that rests is slower along the normal than cloth that bounces",
          "[run]") {
  const ResponseStudy study = study_response(dropped_scene(), 0.02);
  CHECK(study.resting.rms_normal_velocity < 0.5 * study.uniform.rms_normal_velocity);
  CHECK(study.resting.n_touched > 0);
  CHECK(study.resting.normal_velocities.size() ==
        static_cast<std::size_t>(std::llround(0.02 / study.substep)));
  CHECK(study.resting.contact_share > 0);
  CHECK(study.resting.contact_share < 1);
  // The middle falls 5 cm, less what the clearance for flat faces takes.
  CHECK(study.first_contact > 0.08);
  CHECK(study.first_contact < std::sqrt(2 * 0.05 / 9.81));
}

TEST_CASE("response_study: what solids do is what the law of friction says", "[run]") {
  const ResponseStudy study = study_response(dropped_scene(), 0.02);
  for (const ResponseRun* run : {&study.resting, &study.uniform}) {
    REQUIRE(run->friction.has_value());
    CHECK(run->friction->tangential_velocity < 1e-9);
    CHECK(run->friction->momentum < 1e-9);
  }
}

TEST_CASE("response_study: of implicit the law is left out where forces are remembered", "[run]") {
  Scene scene = dropped_scene();
  scene.method = steppers::kImplicitEuler.usual_method();
  scene.method.substeps = 20;
  const ResponseStudy study = study_response(scene, 0.02);
  CHECK_FALSE(study.resting.friction.has_value());
  CHECK(study.uniform.friction.has_value());
  CHECK(study.substep == Approx(1.0 / 1200));
}

TEST_CASE("response_study: it refuses scenes that tell nothing of responses", "[run]") {
  const auto refusal = [](const Scene& scene, double window = 0.02) {
    try {
      study_response(scene, window);
    } catch (const InputError& error) {
      return error.where();
    }
    return std::string("none");
  };
  Scene bare = dropped_scene();
  bare.colliders.clear();
  CHECK(refusal(bare) == "/world/colliders");
  Scene moving = dropped_scene();
  moving.colliders[0].motion = steady_motion(Vec3(0, 1, 0));
  CHECK(refusal(moving) == "/world/colliders/0/motion");
  Scene unfit = dropped_scene();
  unfit.method = steppers::kXpbd.usual_method();
  CHECK(refusal(unfit) == "/method/stepper");
  CHECK(refusal(dropped_scene(0.02)) == "/duration_s");
  CHECK(refusal(dropped_scene(0.11), 0.05) == "/duration_s");
}

TEST_CASE("response_study: a window shorter than a substep is one", "[run]") {
  CHECK(study_response(dropped_scene(), 1e-9).resting.normal_velocities.size() == 1);
}

}  // namespace pleat
