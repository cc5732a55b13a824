#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/command_table.h"
#include "cli/modal_input.h"
#include "cli/overwriting.h"
#include "core/base/core_version.h"
#include "core/modal/frame_measures.h"

namespace pleat {
namespace {

constexpr int kUsualFrames = 60;
constexpr int kMostFrames = 10'000;

bool has_converged(const KeyCompletion::Frame& frame) {
  return std::all_of(frame.bodies.begin(), frame.bodies.end(),
                     [](const ModalBody::Shape& shape) { return shape.converged; });
}

/// How far a vertex moves at most from one frame to the next [m].
double widest_step(const KeyCompletion& completion,
                   const std::vector<KeyCompletion::Frame>& frames) {
  double widest = 0;
  Positions before = completion.surface(frames.front());
  for (std::size_t f = 1; f < frames.size(); ++f) {
    const Positions next = completion.surface(frames[f]);
    widest = std::max(widest, (next - before).colwise().norm().maxCoeff());
    before = next;
  }
  return widest;
}

Json json_frames(const KeyCompletion& completion, const std::vector<KeyCompletion::Frame>& frames) {
  const std::vector<FrameMeasures> measures = frame_measures(completion, frames);
  const std::vector<FrameMeasures> linear = linear_measures(completion, frames);
  Json json = Json::array();
  for (std::size_t f = 0; f < frames.size(); ++f)
    json.push_back({{"time", frames[f].time},
                    {"is_key", frames[f].is_key()},
                    {"volume_m3", measures[f].volume},
                    {"linear_volume_m3", linear[f].volume},
                    {"strain", measures[f].strain},
                    {"linear_strain", linear[f].strain},
                    {"inverted", measures[f].n_inverted},
                    {"linear_inverted", linear[f].n_inverted},
                    {"unequal_halves", measures[f].unequal_halves},
                    {"converged", has_converged(frames[f])}});
  return json;
}

/// Volumes and modes are those of the bodies together.
Json json_inbetween(const KeyCompletion& completion, Json frames) {
  int n_volume_vertices = 0, n_tets = 0, n_functions = 0, n_clusters = 0, n_with_modes = 0;
  for (const ModalBody& body : completion.bodies()) {
    n_volume_vertices += body.carrying().volume.n_vertices();
    n_tets += static_cast<int>(body.carrying().volume.tets.size());
    n_functions += body.space().size();
    n_clusters += body.arap().n_clusters();
    n_with_modes += static_cast<int>(body.modes().size());
  }
  return {{"n_keys", completion.n_keys()},
          {"n_bodies", completion.bodies().size()},
          {"n_volume_vertices", n_volume_vertices},
          {"n_tets", n_tets},
          {"n_functions", n_functions},
          {"n_clusters", n_clusters},
          {"n_keys_with_modes", n_with_modes},
          {"frames", std::move(frames)},
          {"core", core_version()}};
}

void print_inbetween(const Json& json) {
  std::printf(
      "%d keys, %d part%s, volume of %d vertices and %d tetrahedra, %d functions, %d "
      "clusters\n",
      json["n_keys"].get<int>(), json["n_bodies"].get<int>(), json["n_bodies"] == 1 ? "" : "s",
      json["n_volume_vertices"].get<int>(), json["n_tets"].get<int>(),
      json["n_functions"].get<int>(), json["n_clusters"].get<int>());
  std::printf("frame  time     volume [m3]  linear       strain %%    linear      halves differ\n");
  int n = 0;
  for (const Json& frame : json["frames"])
    std::printf(
        "%5d  %-7.4g  %-11.5g  %-11.5g  %-10.4g  %-10.4g  %s\n", n++, frame["time"].get<double>(),
        frame["volume_m3"].get<double>(), frame["linear_volume_m3"].get<double>(),
        100 * frame["strain"].get<double>(), 100 * frame["linear_strain"].get<double>(),
        frame["is_key"].get<bool>()
            ? "key"
            : (Json(std::round(1e4 * frame["unequal_halves"].get<double>()) / 100).dump() + " %")
                  .c_str());
}

/// Sentences on what a reader should know of the frames; mostly none.
std::vector<std::string> warnings(const Json& json) {
  std::vector<std::string> all;
  if (const auto step = json.find("wanted_step_m");
      step != json.end() && json["widest_step_m"] > *step)
    all.push_back("a vertex still moves by " + json["widest_step_m"].dump() +
                  " m from one frame to the next; more frames (--frames) would shorten that");
  int n_inverted = 0, n_unconverged = 0;
  for (const Json& frame : json["frames"]) {
    n_inverted += frame["inverted"] > 0 ? 1 : 0;
    n_unconverged += frame["converged"].get<bool>() ? 0 : 1;
  }
  if (n_inverted > 0)
    all.push_back(std::to_string(n_inverted) +
                  " frames have parts of the volume turned inside out");
  if (n_unconverged > 0)
    all.push_back(std::to_string(n_unconverged) + " frames stopped short of their middle");
  const int n_without = json["n_keys"].get<int>() * json["n_bodies"].get<int>() -
                        json["n_keys_with_modes"].get<int>();
  if (n_without > 0)
    all.push_back(std::to_string(n_without) +
                  " keys turn their volume inside out and give no modes of their own; a thinner "
                  "shell (--size) may not");
  return all;
}

Outcome inbetween_command(Arguments arguments) {
  const bool for_machines = arguments.flag("--json");
  const bool checks = arguments.flag("--check");
  const auto n_frames = arguments.whole_number("--frames", 2, kMostFrames);
  const auto step = arguments.number("--step");  // [m]
  const ModalOptions modal = take_completion_options(arguments);
  FrameFolder out(arguments);
  const KeySurfaces keys = take_keys(arguments);
  out.prepare(keys.files);
  const KeyCompletion completion(keys.positions, keys.mesh.triangles, modal);
  const auto frames = step ? completion.frames_by_step(*step, n_frames.value_or(kMostFrames))
                           : completion.frames(n_frames.value_or(kUsualFrames));
  Json json = json_inbetween(completion, json_frames(completion, frames));
  if (step) {
    json["wanted_step_m"] = *step;
    json["widest_step_m"] = widest_step(completion, frames);
  }
  if (for_machines)
    std::printf("%s\n", json.dump().c_str());
  else
    print_inbetween(json);
  const std::vector<std::string> told = warnings(json);
  for (const std::string& warning : told)
    std::fprintf(stderr, "pleat: warning: %s\n", warning.c_str());
  if (out) {
    FrameWriter writer = out.open(FrameFormat::obj, {{}, keys.mesh.triangles});
    for (const KeyCompletion::Frame& frame : frames)
      writer.write(completion.surface(frame), frame.time);
    writer.finish();
  }
  return checks && !told.empty() ? Outcome::check_failed : Outcome::ok;
}

}  // namespace

extern const Command kInbetweenCommand(
    "inbetween", "A.obj B.obj ...", "frames between key shapes with the same vertices and faces",
    inbetween_command, {kCompletionHelp, kOverwriteHelp, kJsonHelp},
    R"(  --frames N             with the keys (default 60);  --step D  until no vertex moves farther [m]
  --out DIR              write the frames as OBJ files
  --check                exit status 1 when there is a warning
)");

}  // namespace pleat
