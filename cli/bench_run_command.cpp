#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "cli/bare_cloth.h"
#include "cli/command_table.h"
#include "cli/progress.h"
#include "cli/reference_folder.h"
#include "cli/scene_input.h"
#include "core/base/core_version.h"
#include "core/base/formatted.h"
#include "core/dynamics/stepper_table.h"
#include "core/error/run_comparison.h"
#include "core/reference/chain_reference.h"
#include "core/reference/closed_form_reference.h"
#include "core/run/part_timer.h"
#include "core/run/rest_watch.h"
#include "core/run/sampled_run.h"
#include "core/run/timed_run.h"
#include "core/scene/format/method_section.h"
#include "core/sweep/bench_row.h"
#include "core/sweep/platform.h"

namespace pleat {
namespace {

constexpr double kFrame = 1.0 / 60;  // [s]

std::vector<double> take_times(Arguments& arguments) {
  std::vector<double> times;
  for (const std::string& entry : arguments.list("--times")) {
    const double time = parse_number(entry, "--times");
    if (!times.empty() && time < times.back())
      throw InputError("--times", "expected ascending times, got " + cut(entry) + " after " +
                                      Json(times.back()).dump());
    times.push_back(time);
  }
  return times;
}

Json sample_json(const Sample& sample) {
  const double* begin = sample.positions.data();
  return {{"time_s", sample.time},
          {"rms_stretch", sample.stretch.rms},
          {"largest_stretch", sample.stretch.largest},
          {"positions_m", std::vector<double>(begin, begin + sample.positions.size())}};
}

struct BenchOptions {
  bool wants_parts = false;
  bool takes_turns = false;  // runs in turn with another program, by lines on stdin and stdout
  bool is_bare = false;      // the stepper alone
  bool looks_for_rest = false;
  int n_frames = 60;
  std::vector<double> times;
};

/// Lets another program take its turn: says so in a line and waits for one with the number of
/// frames of the next turn. Without a number the rest are run.
int await_turn(int n_left) {
  std::printf("ready\n");
  std::fflush(stdout);
  int n_frames = 0;
  if (std::scanf("%d", &n_frames) != 1) return n_left;
  return std::clamp(n_frames, 1, n_left);
}

/// Looks whether the cloth is at rest, and balanced there. Returns the wall time [ms].
double look_ms(RestWatch& rest, const Simulation& simulation) {
  const Stopwatch stopwatch;
  rest.after_step(simulation);
  return 1e3 * stopwatch.elapsed();
}

/// Runs frame by frame and prints wall time, stretch, parts, and positions at the end of some
/// frames.
template <class Cloth>
Outcome run_bench(const Scene& scene, const BenchOptions& options) {
  const std::int64_t n_steps = steps_of_frame(scene.method.step, kFrame);
  Cloth cloth(scene);
  TimedRun run(cloth, options.wants_parts ? TimedRun::Parts::timed : TimedRun::Parts::untimed);
  Progress progress;
  std::optional<RestWatch> rest;
  if constexpr (std::is_same_v<Cloth, Simulation>) {
    if (options.looks_for_rest) rest.emplace(cloth);
  }
  double first_ms = 0;  // the first frame, in which things are built once
  std::vector<double> ms, processor_ms, rest_ms, rms_stretch, largest_stretch;
  Json samples = Json::array();
  int turn_end = options.takes_turns ? 1 : options.n_frames;
  for (int frame = 0; frame < options.n_frames; ++frame) {
    if (frame == turn_end) turn_end += await_turn(options.n_frames - frame);
    const double processor_start = process_processor_time().value_or(0);
    const double seconds = run.advance(n_steps);
    const double processor_seconds = process_processor_time().value_or(0) - processor_start;
    if (run.has_ended()) break;
    if constexpr (std::is_same_v<Cloth, Simulation>) {
      if (rest) rest_ms.push_back(look_ms(*rest, cloth));
    }
    if (frame > 0) {
      ms.push_back(1e3 * seconds);
      processor_ms.push_back(1e3 * processor_seconds);
    } else {
      first_ms = 1e3 * seconds;
    }
    const Stretch now = stretch(cloth.gauge(), cloth.state().positions);
    rms_stretch.push_back(now.rms);
    largest_stretch.push_back(now.largest);
    if (samples.size() < options.times.size() &&
        cloth.time() > options.times[samples.size()] - kFrame / 2)
      samples.push_back(sample_json({cloth.time(), cloth.state().positions, now}));
    progress.show((frame + 1.0) / options.n_frames, scene.name);
  }
  const SolveReport& report = run.report();
  const auto n_frames = static_cast<double>(std::max<std::size_t>(1, rms_stretch.size()));
  const auto& masses = cloth.model().masses;
  Json json = {{"scene", scene.name},
               {"method", json_method(scene.method)},
               {"level", scene.level},
               {"n_vertices", cloth.model().n_vertices()},
               {"n_substeps", cloth.substeps()},
               {"first_ms", first_ms},
               {"ms", ms},
               {"processor_ms", processor_ms},
               {"rms_stretch", rms_stretch},
               {"largest_stretch", largest_stretch},
               {"residual", report.relative_residual},
               {"iterations_per_frame", report.iterations / n_frames},
               {"status", name(report.status)},
               {"message", report.message},
               {"target", build_target()},
               {"core", core_version()},
               {"samples", samples},
               {"masses_kg", std::vector<double>(masses.data(), masses.data() + masses.size())}};
  if (rest) json["rest_ms"] = rest_ms;
  if (options.wants_parts)
    json["parts_ms"] = json_parts(
        run.parts().mean_ms(std::max<double>(1, run.n_timed()) / static_cast<double>(n_steps)));
  if (const auto memory = process_peak_memory()) json["process_peak_memory_bytes"] = *memory;
  std::printf("%s\n", json.dump().c_str());
  if (!report.ends_run()) return Outcome::ok;
  print_early_end(std::llround(cloth.time() / scene.method.step), report, "");
  return Outcome::check_failed;
}

Outcome bench_run(Arguments arguments) {
  BenchOptions options;
  options.wants_parts = arguments.flag("--parts");
  options.takes_turns = arguments.flag("--turns");
  options.is_bare = arguments.flag("--bare");
  options.looks_for_rest = arguments.flag("--rest");
  options.n_frames = arguments.whole_number("--frames", 2, 1'000'000).value_or(options.n_frames);
  options.times = take_times(arguments);
  if (!options.times.empty() && options.times.back() > (options.n_frames + 0.5) * kFrame)
    throw InputError("--times", "expected times within the " + std::to_string(options.n_frames) +
                                    " frames of 1/60 s that --frames says, got " +
                                    Json(options.times.back()).dump() + " s");
  arguments.refuse({"--steps", "--duration"}, "bench run does not take this option, but --frames");
  const SceneInput input = take_scene(arguments);
  if (options.is_bare && options.looks_for_rest)
    throw InputError("--rest", "a bare stepper has no model to look at");
  if (options.looks_for_rest && std::abs(input.scene.method.step - kFrame) > 1e-9)
    throw InputError(
        "--rest", "expected steps of a frame, 1/60 s, got " + Json(input.scene.method.step).dump());
  return with_source_named(input, [&] {
    return options.is_bare ? run_bench<BareCloth>(input.scene, options)
                           : run_bench<Simulation>(input.scene, options);
  });
}

/// The scene's own run, for taking it as a reference: its method is the one that makes it. Nothing,
/// with a sentence on stderr, when the numbers ended the run.
std::optional<Reference> run_reference(const Scene& scene, const std::vector<double>& times,
                                       ReferenceStore& store) {
  const std::string id = reference_id("run", scene, times);
  if (auto known = store.find(id)) return known;
  SampledRun run(scene, times, SampledRun::Parts::untimed);
  finish(run, scene.name);
  if (run.failed()) {
    std::fprintf(stderr, "pleat: no reference, as its run ended early: %s\n",
                 run.report().message.c_str());
    return std::nullopt;
  }
  const MethodOptions& method = run.simulation().scene().method;
  const Reference reference{{id,
                             std::string(method.stepper->name) + " with " + name(method.solver) +
                                 ", step " + step_phrase(method.step / run.simulation().substeps()),
                             false},
                            run.samples()};
  store.keep(reference);
  return reference;
}

std::string millimetres(const std::vector<double>& lengths) {
  std::string text;
  for (const double length : lengths)
    text += (text.empty() ? "" : " / ") + three_digits(1e3 * length);
  return text + " mm";
}

/// Notes in a run's label how far it is from the same run at twice the step. Nothing when the
/// numbers ended that one.
std::optional<Reference> with_step_halved(Reference reference, Scene scene,
                                          const std::vector<double>& times, ReferenceStore& store) {
  const Scene fine = scene;
  scene.method.step *= 2;
  const std::optional<Reference> coarse = run_reference(scene, times, store);
  if (!coarse) return std::nullopt;
  const std::vector<double> changes = sample_distances(fine, coarse->samples, reference.samples);
  for (std::size_t t = 0; t < changes.size(); ++t) reference.samples[t].uncertainty = changes[t];
  reference.label.description += "; halving its step changed it by " + millimetres(changes);
  reference.label.uncertainty = changes.back();
  return reference;
}

Outcome bench_reference(Arguments arguments) {
  const std::string kind = arguments.choice(
      "--kind", std::string("run"),
      {{"run", "run"}, {"rigid_chain", "rigid_chain"}, {"closed_form", "closed_form"}});
  const auto cache = arguments.text("--cache");
  const bool halves_step = arguments.flag("--halved");
  if (halves_step && kind != "run") throw InputError("--halved", kind + " has no step to halve");
  std::vector<double> times = take_times(arguments);
  if (!times.empty())
    arguments.refuse({"--steps", "--duration"}, "expected either this or --times, got both");
  if (kind != "run")
    arguments.refuse(
        {"--stepper", "--step", "--substeps", "--iterations", "--solver", "--tolerance"},
        kind + " has no method; only --kind run takes this option");
  const SceneInput input = take_scene(arguments);
  const Scene& scene = input.scene;
  if (times.empty()) times = {scene.duration};
  if (times.back() > static_cast<double>(kMaxSteps) * scene.method.step)
    throw InputError("--times", "expected at most 1e9 steps of the scene, got " +
                                    Json(times.back() / scene.method.step).dump());
  std::unique_ptr<ReferenceStore> store = std::make_unique<MemoryReferenceStore>();
  if (cache) store = std::make_unique<ReferenceFolder>(*cache);
  const std::optional<Reference> reference = with_source_named(input, [&] {
    if (kind == "run") {
      auto run = run_reference(scene, times, *store);
      return run && halves_step ? with_step_halved(*run, scene, times, *store) : run;
    }
    return std::optional(kind == "rigid_chain" ? chain_reference(scene, times)
                                               : closed_form_reference(scene, times));
  });
  if (!reference) return Outcome::check_failed;
  Json samples = Json::array();
  for (const Sample& sample : reference->samples) {
    samples.push_back(sample_json(sample));
    if (halves_step) samples.back()["halving_changed_m"] = sample.uncertainty;
  }
  const Json json = {{"reference", json_label(reference->label)},
                     {"rest_diagonal_m", scene.cloth->rest_diagonal()},
                     {"samples", samples}};
  std::printf("%s\n", json.dump().c_str());
  return Outcome::ok;
}

}  // namespace

extern const Command kBenchRun(
    "run", "SCENE.json", "what one run costs, with positions to compare", bench_run,
    {kFabricHelp, kMethodHelp},
    R"(  --frames N             of 1/60 s (default 60);  --times T1,T2  of the positions, within them
  --parts                what the parts of a step cost
  --bare                 the stepper alone on masses, springs, pins and weight: what else a scene
                         could ask for costs, where it does not, what a run takes more than this
  --rest                 what looks take whether cloth at rest is balanced, one after each step
  --turns                print "ready" after the first frame and wait for a line with the number of
                         frames of the next turn, until all have been run
)");

extern const Command kBenchReference(
    "reference", "SCENE.json", "positions that are taken for right", bench_reference,
    {kFabricHelp, kMethodHelp, kTimeHelp},
    R"(  --times T1,T2          of the positions (default: the scene's end, or that of --steps, --duration)
  --kind KIND            run (default), or rigid_chain or closed_form, which take no option of a
                         method
  --cache DIR            keep runs here;  --halved  how far twice the step is from it
)");

}  // namespace pleat
