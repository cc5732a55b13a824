#include <cstdio>

#include "cli/command_table.h"
#include "cli/scene_input.h"
#include "core/run/response_study.h"
#include "core/scene/format/method_section.h"

namespace pleat {
namespace {

constexpr double kWindow = 0.05;  // [s]

Json response_json(const ResponseRun& run) {
  Json json = {{"rms_normal_velocity_m_per_s", run.rms_normal_velocity},
               {"n_touched", run.n_touched},
               {"contact_share", run.contact_share},
               {"tangential_velocity_deviation", Json()},
               {"momentum_deviation", Json()}};
  if (run.friction) {
    json["tangential_velocity_deviation"] = run.friction->tangential_velocity;
    json["momentum_deviation"] = run.friction->momentum;
  }
  return json;
}

Outcome bench_response(Arguments arguments) {
  const double window = arguments.number("--window").value_or(kWindow);
  const SceneInput input = take_scene(arguments);
  return with_source_named(input, [&] {
    const ResponseStudy study = study_response(input.scene, window);
    const Json json = {{"scene", input.scene.name},
                       {"method", json_method(input.scene.method)},
                       {"window_s", window},
                       {"substep_s", study.substep},
                       {"first_contact_s", study.first_contact},
                       {"resting", response_json(study.resting)},
                       {"uniform", response_json(study.uniform)}};
    std::printf("%s\n", json.dump().c_str());
    return Outcome::ok;
  });
}

}  // namespace

extern const Command kBenchResponse(
    "response", "SCENE.json", "how touched vertices move along the normal after first contact",
    bench_response, {kFabricHelp, kMethodHelp, kTimeHelp},
    R"(  --window S             after first contact (default: 0.05)
  Once with cloth that rests on solids and once with cloth that bounces.
)");

}  // namespace pleat
