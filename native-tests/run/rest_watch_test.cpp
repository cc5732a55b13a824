#include "core/run/rest_watch.h"

#include <array>
#include <catch2/catch.hpp>

#include "core/dynamics/implicit/stepper_implicit.h"
#include "core/dynamics/stepper_table.h"
#include "core/run/run_watch.h"
#include "core/scene/format/scene_file.h"
#include "core/scene/format/scene_override.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

struct OwnModel {
  explicit OwnModel(const ClothModel& model) : own(model) {}
  ClothModel own;
};

/// Implicit on a model of its own, in which nothing resists bending.
struct WithoutBending : OwnModel, StepperImplicit {
  static ClothModel changed(ClothModel model) {
    model.bends.clear();
    model.chord_bends.clear();
    return model;
  }
  WithoutBending(ClothModel& model, const MethodOptions& options)
      : OwnModel(changed(model)), StepperImplicit(own, options) {}
};

/// Implicit on a model of its own, in twice the drag.
struct InTwiceTheDrag : OwnModel, StepperImplicit {
  static ClothModel changed(ClothModel model) {
    if (model.air) model.air->set_strength(2);
    return model;
  }
  InTwiceTheDrag(ClothModel& model, const MethodOptions& options)
      : OwnModel(changed(model)), StepperImplicit(own, options) {}
};

template <class Faulty>
StepperType faulty(const char* name) {
  StepperType type = steppers::kImplicitEuler;
  type.name = name;
  type.make = [](ClothModel& model, const MethodOptions& options) -> std::unique_ptr<Stepper> {
    return std::make_unique<Faulty>(model, options);
  };
  return type;
}

const StepperType kWithoutBending = faulty<WithoutBending>("without_bending");
const StepperType kInTwiceTheDrag = faulty<InTwiceTheDrag>("in_twice_the_drag");
const std::array<const StepperType*, 7> kTable = {
    &steppers::kImplicitEuler, &steppers::kProjective, &steppers::kXpbd, &steppers::kPbd,
    &steppers::kMultigrid,     &kWithoutBending,       &kInTwiceTheDrag};

/// A strip of linen of two bending lengths, clamped in its first two rows.
const char* const kCantilever = R"({
  "cloth": {"sheet": {"width_m": 0.0111, "height_m": 0.0585, "columns": 4, "rows": 21,
                      "origin_m": [0, 1, -0.0028], "warp_direction": [0, 0, 1],
                      "weft_direction": [1, 0, 0]}},
  "fabric": {"name": "linen"}, "world": {"air": {}},
  "pins": [{"box": {"low_m": [-1, 0.9, -0.003], "high_m": [1, 1.1, 0.0003]}}]})";

/// A sheet of 20 cm that hangs from its upper edge.
const char* const kHung = R"({
  "cloth": {"sheet": {"width_m": 0.2, "height_m": 0.2, "columns": 8, "rows": 8,
                      "origin_m": [0, 1, 0], "warp_direction": [0, -1, 0]}},
  "fabric": {"name": "linen"}, "pins": [{"part": "upper_edge"}]})";

/// A limp curtain in the plane in which wind of 1.4 m/s and weight balance.
const char* const kInWind = R"({
  "cloth": {"sheet": {"width_m": 0.5, "height_m": 0.5, "columns": 10, "rows": 10,
                      "origin_m": [0, 1, 0],
                      "warp_direction": [0, -0.6891186054177533, 0.724648568388216]}},
  "fabric": {"name": "fine cotton"}, "model": {"bending": "none"},
  "pins": [{"part": "upper_edge"}],
  "world": {"air": {"wind": {"velocity_m_per_s": [0, 0, 1.4]}}}})";

/// A sheet of 20 cm that falls flat.
const char* const kFalling = R"({
  "cloth": {"sheet": {"width_m": 0.2, "height_m": 0.2, "columns": 4, "rows": 4,
                      "origin_m": [0, 0, 0], "warp_direction": [0, 0, 1]}},
  "fabric": {"name": "linen"}, "world": {"air": {}}})";

Scene scene_of(const char* text, const char* stepper, double duration) {
  Json json = parse_json(text);
  json["method"]["stepper"] = stepper;
  json["duration_s"] = duration;
  return read_scene(JsonReader(json), fabric_library(), {}, {.steppers = kTable});
}

/// A run to its end that is watched.
struct WatchedRun {
  Simulation simulation;
  RunWatch watch;
  int n_looks = 0;
  double work_of_looks = 0;

  explicit WatchedRun(const Scene& scene) : simulation(scene), watch(simulation) {
    double last_look = -1;
    while (simulation.time() < scene.duration - scene.method.step / 2) {
      const SolveReport report = simulation.step();
      REQUIRE_FALSE(report.ends_run());
      watch.check(simulation, report);
      const auto& look = watch.rest().last();
      if (look && std::exchange(last_look, look->time) != look->time) ++n_looks;
    }
    work_of_looks = watch.rest().work();
    watch.check_end(simulation);
  }

  double share() const { return watch.unbalanced_share(); }
  bool is_told() const {
    for (const RunWarning& warning : watch.warnings())
      if (warning.kind == RunWarning::Kind::unbalanced) return true;
    return false;
  }
};

}  // namespace

TEST_CASE("rest_watch: cloth that came to hang by bending is balanced, and told without it",
          "[run]") {
  const WatchedRun right(scene_of(kCantilever, "implicit", 3));
  CHECK(right.share() < 0.01);
  CHECK_FALSE(right.is_told());
  const WatchedRun faulty(scene_of(kCantilever, "without_bending", 3));
  CHECK(faulty.share() > 0.2);
  CHECK(faulty.is_told());
}

TEST_CASE("rest_watch: cloth that falls steadily is balanced, and told in twice the drag",
          "[run]") {
  const WatchedRun right(scene_of(kFalling, "implicit", 1.5));
  CHECK(right.share() < 0.02);
  CHECK_FALSE(right.is_told());
  const WatchedRun faulty(scene_of(kFalling, "in_twice_the_drag", 1.5));
  CHECK(faulty.share() == Approx(0.5).epsilon(0.05));
  CHECK(faulty.is_told());
}

// Advice is followed to the letter.
TEST_CASE("rest_watch: what too few rounds hold up is told, and the advice helps", "[run]") {
  const char* stepper = GENERATE("projective", "pbd");
  CAPTURE(stepper);
  const Scene scene = scene_of(kCantilever, stepper, 4);
  const WatchedRun held(scene);
  CAPTURE(held.share());
  REQUIRE(held.is_told());
  const SettingHint& hint = held.watch.warnings().back().hints.front();
  Json json = parse_json(write_scene(scene));
  const std::array<SceneOverride, 1> change = {{{hint.pointer, hint.value}}};
  override_scene(json, change);
  const WatchedRun advised(read_scene(JsonReader(json), fabric_library()));
  CHECK(advised.share() < 0.01);
  CHECK_FALSE(advised.is_told());
}

TEST_CASE("rest_watch: cloth that hangs is balanced", "[run]") {
  const char* stepper = GENERATE("implicit", "projective", "xpbd", "multigrid");
  CAPTURE(stepper);
  const WatchedRun run(scene_of(kHung, stepper, 2));
  CHECK(run.share() < 0.05);
  CHECK_FALSE(run.is_told());
}

TEST_CASE("rest_watch: a limp curtain that wind holds up comes to rest", "[run]") {
  const char* stepper = GENERATE("projective", "xpbd", "multigrid");
  CAPTURE(stepper);
  const WatchedRun run(scene_of(kInWind, stepper, 5));
  CHECK(run.simulation.state().velocities.colwise().norm().maxCoeff() < 1e-4);
  CHECK_FALSE(run.is_told());
}

TEST_CASE("rest_watch: cloth that falls freely is not looked at", "[run]") {
  const WatchedRun run(scene_of(R"({"cloth": {"sheet": {"columns": 2, "rows": 2}}})", "xpbd", 1));
  CHECK(run.watch.rest().work() == 0);
  CHECK_FALSE(run.is_told());
}

TEST_CASE("rest_watch: looks take a hundredth of the work of the steps", "[run]") {
  const char* stepper = GENERATE("implicit", "pbd");
  CAPTURE(stepper);
  const WatchedRun run(scene_of(kHung, stepper, 60));
  const MethodOptions& method = run.simulation.scene().method;
  const double work = static_cast<double>(run.simulation.n_steps()) * run.simulation.substeps() *
                      method.stepper->substep_cost(method);
  CHECK(run.n_looks >= 2);
  CHECK(run.work_of_looks <= 0.01 * work);
  CHECK(run.watch.rest().work() > run.work_of_looks);
}

// One vertex slips where another sticks, in as many rounds of contact forces as there may be.
TEST_CASE("rest_watch: a look at cloth that is far off on a ball ends before its contacts settle",
          "[run]") {
  Json json = parse_json(scene_text("tablecloth"));
  json.erase("method");
  const WatchedRun run(scene_of(json.dump().c_str(), "projective", 10));
  CHECK(run.is_told());
  CHECK(run.work_of_looks == 0);  // the only one is that of the end
  CHECK(run.watch.rest().work() < 1000);
}

TEST_CASE("rest_watch: looks leave the run as it is to the bit", "[run]") {
  const Scene scene = scene_of(kHung, "implicit", 2);
  const WatchedRun watched(scene);
  Simulation alone(scene);
  while (alone.n_steps() < watched.simulation.n_steps()) alone.step();
  CHECK(watched.watch.rest().work() > 0);
  CHECK(alone.state().positions == watched.simulation.state().positions);
}

}  // namespace pleat
