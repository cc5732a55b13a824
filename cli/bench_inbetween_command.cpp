#include <algorithm>
#include <cstdio>

#include "cli/command_table.h"
#include "cli/modal_input.h"
#include "core/base/core_version.h"
#include "core/files/frame_file.h"
#include "core/sweep/completion_cost.h"
#include "core/sweep/platform.h"

namespace pleat {
namespace {

/// The largest numbers of all frames, and the sums.
Json measures_json(const std::vector<FrameMeasures>& measures) {
  double change = 0, unequal = 0;
  int n_inverted = 0;
  for (const FrameMeasures& of : measures) {
    change = std::max(change, std::abs(of.volume / measures.front().volume - 1));
    unequal = std::max(unequal, of.unequal_halves);
    n_inverted += of.n_inverted;
  }
  return {{"volume_change", change}, {"inverted", n_inverted}, {"unequal_halves", unequal}};
}

std::vector<Positions> read_frames(const std::string& folder, const ObjMesh& like) {
  std::vector<Positions> frames;
  for (const std::filesystem::path& file : frame_files(folder)) {
    const ObjMesh mesh = read_obj(read_file(file));
    if (mesh.positions.cols() != like.positions.cols())
      throw FileError(file, "expected " + std::to_string(like.positions.cols()) +
                                " vertices as the keys have, got " +
                                std::to_string(mesh.positions.cols()));
    frames.push_back(mesh.positions);
  }
  if (frames.empty()) throw FileError(folder, "expected a run's frames as OBJ files, got none");
  return frames;
}

Outcome bench_inbetween(Arguments arguments) {
  const int n_frames = arguments.whole_number("--frames", 2, kMaxFrames).value_or(60);
  const auto against = arguments.text("--against");
  const bool wants_unreduced = arguments.flag("--unreduced");
  const ModalOptions options = take_completion_options(arguments);
  const KeySurfaces keys = take_keys(arguments);
  const CompletionCost cost =
      completion_cost(keys.positions, keys.mesh.triangles, options, n_frames);
  Json json = {{"n_vertices", keys.mesh.positions.cols()},
               {"n_volume_vertices", cost.n_volume_vertices},
               {"n_tets", cost.n_tets},
               {"n_keys", keys.positions.size()},
               {"n_frames", cost.measures.size()},
               {"precompute_ms", cost.precompute_ms},
               {"middles_ms", cost.middles_ms},
               {"middle_ms", cost.middles_ms / std::max(1, cost.n_middles)},
               {"surfaces_ms", cost.surfaces_ms},
               {"unconverged", cost.n_unconverged},
               {"figures", measures_json(cost.measures)},
               {"linear", measures_json(cost.linear_measures)},
               {"target", build_target()},
               {"core", core_version()}};
  std::optional<UnreducedCost> unreduced;
  if (wants_unreduced && cost.n_bodies > 1)
    throw InputError("--unreduced",
                     "expected a surface in one part, got " + std::to_string(cost.n_bodies));
  if (against && cost.middles.empty())
    throw InputError("--against",
                     "expected more frames than keys, got " + std::to_string(cost.measures.size()));
  if (wants_unreduced) {
    unreduced = unreduced_cost(keys.positions, keys.mesh.triangles, options, n_frames);
    json["unreduced"] = {{"middles_ms", unreduced->middles_ms}};
  }
  if (against) {
    const std::vector<Positions> others = read_frames(*against, keys.mesh);
    json["distance_m"] = mean_distance_to_nearest(cost.middles, others);
    json["linear"]["distance_m"] = mean_distance_to_nearest(cost.linear_middles, others);
    if (unreduced)
      json["unreduced"]["distance_m"] = mean_distance_to_nearest(unreduced->middles, others);
  }
  std::printf("%s\n", json.dump().c_str());
  return Outcome::ok;
}

}  // namespace

extern const Command kBenchInbetween("inbetween", "A.obj B.obj ...",
                                     "what frames between keys cost", bench_inbetween,
                                     {kCompletionHelp},
                                     R"(  --frames N             with the keys (default 60)
  --against DIR          the distance to the nearest of a run's frames;  --unreduced  also of frames
                         for which no space was made
)");

}  // namespace pleat
