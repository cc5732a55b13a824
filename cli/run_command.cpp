#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "cli/command_table.h"
#include "cli/overwriting.h"
#include "cli/progress.h"
#include "cli/run_warnings.h"
#include "cli/scene_input.h"
#include "core/base/core_version.h"
#include "core/dynamics/stepper_table.h"
#include "core/error/self_crossings.h"
#include "core/files/frame_file.h"
#include "core/files/matrix_file.h"
#include "core/model/stretch.h"
#include "core/model/system_matrix.h"
#include "core/run/run_ledger.h"
#include "core/run/scene_model.h"
#include "core/run/simulation.h"
#include "core/run/timed_run.h"
#include "core/scene/format/method_section.h"
#include "core/scene/format/start_section.h"
#include "core/scene/tearing.h"

namespace pleat {
namespace {

/// The results of a whole run.
struct RunSummary {
  SolveReport report;  // of all steps
  Stretch last_stretch;
  double largest_stretch = 0;
  double rms_stretch_sum = 0;       // over steps
  std::int64_t last_crossings = 0;  // of the cloth with itself, where they are counted
  std::int64_t largest_crossings = 0;
  int n_frames = 0;
  std::vector<RunWarning> warnings;
};

/// The folder after --dump and the files in it.
struct Dump {
  std::filesystem::path folder;
  std::filesystem::path mass = folder / "mass.mtx";
  std::filesystem::path stiffness_begin = folder / "stiffness_begin.mtx";
  std::filesystem::path stiffness_end = folder / "stiffness_end.mtx";

  void prepare(const Overwriting& overwriting) const {
    make_folder(folder);
    for (const auto* file : {&mass, &stiffness_begin, &stiffness_end}) overwriting.check(*file);
  }
};

/// The folder after --out.
struct Output {
  std::filesystem::path folder;
  std::filesystem::path metrics = folder / "metrics.json";

  /// Files of an earlier run.
  std::vector<std::filesystem::path> old_files() const {
    std::vector<std::filesystem::path> files = frame_files(folder);
    std::error_code error;
    if (std::filesystem::exists(metrics, error)) files.push_back(metrics);
    if (error)
      throw FileError(metrics, "expected a place that can be read, got \"" + error.message() + '"');
    return files;
  }

  /// Frames of two runs side by side would pass for those of one.
  void prepare(const Overwriting& overwriting) const {
    const std::vector<std::filesystem::path> old = old_files();
    if (!old.empty() && !overwriting.is_asked())
      throw FileError(folder, "expected a folder without a run's files, got " +
                                  old.front().filename().string() +
                                  "; --overwrite removes those of the earlier run");
    make_folder(folder);
    check_writable(metrics);
    for (const std::filesystem::path& file : old) overwriting.check(file);
  }
};

void check_frame_count(const Scene& scene) {
  if (scene.record.format == FrameFormat::none) return;
  const std::int64_t n_frames = 1 + whole_steps(scene.duration, scene.method.step) /
                                        whole_steps(scene.record.every, scene.method.step);
  if (n_frames > kMaxFrames)
    throw InputError("/record/every_s", "expected at most " + std::to_string(kMaxFrames) +
                                            " frames, got " + std::to_string(n_frames));
}

void write_stiffness(const Simulation& simulation, const std::filesystem::path& path) {
  write_file(path, matrix_market_text(stiffness_matrix(
                       simulation.model(), simulation.state().positions, ElementHessian::exact)));
}

void add_step(const Simulation& simulation, RunSummary& summary) {
  summary.last_stretch = stretch(simulation.gauge(), simulation.state().positions);
  summary.largest_stretch = std::max(summary.largest_stretch, summary.last_stretch.largest);
  summary.rms_stretch_sum += summary.last_stretch.rms;
}

FrameMesh frame_mesh(const Simulation& simulation) {
  return {simulation.model().rest_coordinates, simulation.triangles()};
}

SelfCrossings crossings_of(const Simulation& simulation) {
  return {simulation.triangles(), simulation.rest_positions(), simulation.model().hanging};
}

/// Who watches a run; any may be null.
struct Watchers {
  FrameWriter* frames = nullptr;
  SelfCrossings* crossings = nullptr;
  RunLedger* ledger = nullptr;
};

/// Shows a mesh that a tear has changed to those who keep one.
void show_mesh(const Simulation& simulation, const Watchers& watchers) {
  if (watchers.frames != nullptr) watchers.frames->set_mesh(frame_mesh(simulation));
  if (watchers.crossings != nullptr) *watchers.crossings = crossings_of(simulation);
}

/// Hands a frame to everything that watches them.
void add_frame(const Simulation& simulation, const Watchers& watchers, RunSummary& summary) {
  const Positions& positions = simulation.state().positions;
  if (watchers.frames != nullptr) watchers.frames->write(positions, simulation.time());
  if (watchers.crossings == nullptr) return;
  summary.last_crossings = watchers.crossings->count(positions);
  summary.largest_crossings = std::max(summary.largest_crossings, summary.last_crossings);
}

/// Runs to the scene's end or until the numbers end it.
RunSummary run_to_end(Simulation& simulation, const Watchers& watchers) {
  const Scene& scene = simulation.scene();
  const double step = scene.method.step;
  const std::int64_t n_steps = whole_steps(scene.duration, step);
  const std::int64_t steps_per_frame = whole_steps(scene.record.every, step);
  RunSummary summary;
  TimedRun run(simulation, TimedRun::Parts::untimed);
  RunWatch watch(simulation);
  Progress progress;
  add_frame(simulation, watchers, summary);
  std::int64_t topology = simulation.topology();
  while (simulation.n_steps() < n_steps) {
    const SolveReport step_report = run.step();
    if (std::exchange(topology, simulation.topology()) != topology) show_mesh(simulation, watchers);
    const bool ended = run.has_ended();
    add_step(simulation, summary);
    watch.look(simulation, step_report);
    if (watchers.ledger != nullptr) watchers.ledger->look();
    // The last finite frame of a run that ended early is kept, unless it was written already.
    const bool is_frame = (simulation.n_steps() % steps_per_frame == 0) != ended;
    if (is_frame) add_frame(simulation, watchers, summary);
    if (ended) break;
    progress.show(static_cast<double>(simulation.n_steps()) / static_cast<double>(n_steps),
                  scene.name);
  }
  summary.report = run.report();
  summary.warnings = watch.warnings();
  return summary;
}

Json drift_json(const EnergyLedger& ledger) {
  const EnergyLedger::Works& works = ledger.works();
  const EnergyParts& parts = ledger.parts();
  return {{"drift_j", ledger.drift()},
          {"share_of_largest_kinetic_energy", ledger.relative_drift()},
          {"energy_j", parts.sum()},
          {"kinetic_j", parts.kinetic},
          {"elastic_j", parts.elastic},
          {"gravity_j", parts.gravity},
          {"work_of_damping_j", works.damping},
          {"work_of_inner_friction_j", works.bend_friction},
          {"work_of_air_j", works.air},
          {"work_of_pins_j", works.pins},
          {"work_of_contact_j", works.contact},
          {"work_of_tears_j", works.tears}};
}

/// How many springs of all are implicit.
struct ImplicitCount {
  std::size_t count;
  std::size_t all;

  double share() const { return static_cast<double>(count) / static_cast<double>(all); }
};

/// Nothing for steppers that treat all springs alike.
std::optional<ImplicitCount> implicit_count(const Simulation& simulation) {
  const std::span<const char> is_implicit = simulation.implicit_springs();
  if (is_implicit.empty()) return std::nullopt;
  const auto n_explicit = std::count(is_implicit.begin(), is_implicit.end(), char{0});
  return ImplicitCount{is_implicit.size() - static_cast<std::size_t>(n_explicit),
                       is_implicit.size()};
}

/// A 1 for each spring that is implicit, a 0 for others, in the order of the model's springs.
std::string implicit_map(const Simulation& simulation) {
  std::string map;
  for (const char is_implicit : simulation.implicit_springs()) map += is_implicit != 0 ? '1' : '0';
  return map;
}

Json metrics_json(const Simulation& simulation, const RunSummary& summary,
                  const Watchers& watchers) {
  const Scene& scene = simulation.scene();
  const ClothModel& model = simulation.model();
  const BuildReport built = build_report(model, scene.model);
  const auto n_steps = static_cast<double>(std::max<std::int64_t>(1, simulation.n_steps()));
  Json json = {{"scene", scene.name},
               {"fabric", scene.fabric.name},
               {"level", scene.level},
               {"method", json_method(scene.method)},
               {"n_substeps", simulation.substeps()},
               {"n_vertices", model.n_vertices()},
               {"n_triangles", simulation.triangles().size()},
               {"n_springs", model.springs.size()},
               {"n_bends", model.bends.size()},
               {"n_pins", model.pins.size()},
               {"mass_kg", model.masses.sum()},
               {"built", built.built},
               {"built_bytes", built.bytes},
               {"left_out", built.left_out},
               {"remark", simulation.remark()},
               {"status", name(summary.report.status)},
               {"message", summary.report.message},
               {"n_steps", simulation.n_steps()},
               {"time_s", simulation.time()},
               {"n_frames", summary.n_frames},
               {"iterations_per_step", summary.report.iterations / n_steps},
               {"largest_residual", summary.report.relative_residual},
               {"n_unresolved_contacts", model.contact ? model.contact->n_unresolved() : 0},
               {"rms_stretch_at_end", summary.last_stretch.rms},
               {"largest_stretch_at_end", summary.last_stretch.largest},
               {"mean_rms_stretch", summary.rms_stretch_sum / n_steps},
               {"largest_stretch", summary.largest_stretch}};
  if (scene.model.tearing) json["n_splits"] = simulation.tear_origins().size();
  json["warnings"] = json_warnings(summary.warnings);
  if (const StrainLimitStage* limit = simulation.strain_limit()) {
    json["strain_limit_sweeps_per_step"] = static_cast<double>(limit->n_sweeps()) / n_steps;
    json["n_strain_limit_capped"] = limit->n_capped();
  }
  if (watchers.crossings != nullptr) {
    json["crossings_at_end"] = summary.last_crossings;
    json["largest_crossings"] = summary.largest_crossings;
  }
  if (const auto springs = implicit_count(simulation))
    json["implicit_springs"] = {{"count", springs->count},
                                {"all", springs->all},
                                {"share", springs->share()},
                                {"map", implicit_map(simulation)}};
  if (const auto bound = simulation.stability_bound()) json["stability_bound_s"] = *bound;
  if (const auto contact = simulation.first_contact()) json["first_contact_s"] = *contact;
  if (watchers.ledger != nullptr) json["energy"] = drift_json(watchers.ledger->account());
  json["core"] = core_version();
  return json;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text.empty() ? "nothing" : text;
}

/// There may be so many that the first step, and so the first sign of progress, takes minutes.
bool chooses_substeps(const Scene& scene) {
  return scene.method.substeps == kStableSubsteps || scene.method.explicit_share > 0;
}

/// Says what a long run is of.
void print_beginning(const Simulation& simulation) {
  const MethodOptions& method = simulation.scene().method;
  const double substep = method.step / simulation.substeps();
  std::fprintf(stderr, "%s, %d substeps per step, %d vertices\n", method.stepper->name,
               simulation.substeps(), simulation.model().n_vertices());
  const auto bound = simulation.stability_bound();
  if (!bound) return;
  if (*bound > 0)
    std::fprintf(stderr, "stable in substeps of up to %.3g s; these are of %.3g s%s\n", *bound,
                 substep, substep > *bound ? ", and the run may end early" : "");
  else
    std::fprintf(stderr, "no substep is stable; these are of %.3g s, and the run may end early\n",
                 substep);
}

void print_summary(const Simulation& simulation, const RunSummary& summary,
                   const Watchers& watchers) {
  const Scene& scene = simulation.scene();
  const BuildReport built = build_report(simulation.model(), scene.model);
  std::printf("%s: %s, level %d, %d vertices, %s, step %.4g s x %d\n",
              printable(scene.name).c_str(), printable(scene.fabric.name).c_str(), scene.level,
              simulation.model().n_vertices(), scene.method.stepper->name, scene.method.step,
              simulation.substeps());
  std::printf("built: %s\nleft out: %s\n", joined(built.built).c_str(),
              joined(built.left_out).c_str());
  std::printf("%lld steps to %.10g s, status %s\n", static_cast<long long>(simulation.n_steps()),
              simulation.time(), name(summary.report.status));
  std::printf("stretch at the end: rms %.3g %%, largest %.3g %%; largest of all %.3g %%\n",
              100 * summary.last_stretch.rms, 100 * summary.last_stretch.largest,
              100 * summary.largest_stretch);
  if (const std::string remark = simulation.remark(); !remark.empty())
    std::printf("method: %s\n", remark.c_str());
  if (!summary.report.message.empty() && !summary.report.ends_run())
    std::printf("%s\n", summary.report.message.c_str());
  std::printf("largest residual %.3g\n", summary.report.relative_residual);
  if (const auto springs = implicit_count(simulation))
    std::printf("implicit springs: %zu of %zu, %.3g %%\n", springs->count, springs->all,
                100 * springs->share());
  if (const auto contact = simulation.first_contact())
    std::printf("first contact at %.10g s\n", *contact);
  if (scene.model.tearing)
    std::printf("tears: %zu vertices were split\n", simulation.tear_origins().size());
  if (watchers.crossings != nullptr)
    std::printf("crossings of the cloth with itself: %lld in the last frame, at most %lld\n",
                static_cast<long long>(summary.last_crossings),
                static_cast<long long>(summary.largest_crossings));
  if (watchers.ledger != nullptr) {
    const EnergyLedger& ledger = watchers.ledger->account();
    std::printf("energy drift %.3g J, %.3g %% of the largest kinetic energy\n", ledger.drift(),
                100 * ledger.relative_drift());
  }
}

struct RunOptions {
  bool for_machines = false;
  bool checks = false;
  bool wants_drift = false;
  std::optional<Output> out;
  std::optional<Dump> dump;
  std::optional<std::filesystem::path> state;
};

/// Slower cloth is written as if it were at rest [m/s].
constexpr double kRestSpeed = 1e-2;

/// For a scene's "start": to a micrometre, and a micrometre per second.
std::string state_text(const State& state) {
  const auto rounded = [](const Positions& columns) {
    constexpr double kPerUnit = 1e6;
    return Positions((columns * kPerUnit).array().round() / kPerUnit);
  };
  StartState start{rounded(state.positions), {}, 0};
  if (state.velocities.colwise().norm().maxCoeff() > kRestSpeed)
    start.velocities = rounded(state.velocities);
  return json_start(start).dump() + '\n';
}

Outcome run_scene(const Scene& scene, const RunOptions& options, const Overwriting& overwriting) {
  const auto& [for_machines, checks, wants_drift, out, dump, state] = options;
  if (out) check_frame_count(scene);
  if (dump || state) expect_whole(scene);
  Simulation simulation(scene);
  if (dump) dump->prepare(overwriting);
  if (state) overwriting.check(*state);
  if (out) out->prepare(overwriting);
  if (!for_machines || chooses_substeps(scene)) print_beginning(simulation);
  if (dump) {
    write_file(dump->mass, matrix_market_text(mass_matrix(simulation.model())));
    write_stiffness(simulation, dump->stiffness_begin);
  }
  std::optional<FrameWriter> frames;
  if (out) {
    for (const std::filesystem::path& file : out->old_files()) remove_file(file);
    frames.emplace(out->folder.string(), scene.record.format, frame_mesh(simulation));
  }
  std::optional<RunLedger> ledger;
  if (wants_drift) ledger.emplace(simulation);
  std::optional<SelfCrossings> crossings;
  if (frames || scene.cloth->is_worn()) crossings = crossings_of(simulation);
  const Watchers watchers{frames ? &*frames : nullptr, crossings ? &*crossings : nullptr,
                          ledger ? &*ledger : nullptr};
  RunSummary summary = run_to_end(simulation, watchers);
  if (frames) {
    frames->finish();
    summary.n_frames = frames->n_frames();
  }

  const Json metrics = metrics_json(simulation, summary, watchers);
  if (for_machines)
    std::printf("%s\n", metrics.dump().c_str());
  else
    print_summary(simulation, summary, watchers);
  if (out) write_file(out->metrics, format_json(metrics));
  if (dump) write_stiffness(simulation, dump->stiffness_end);
  if (!summary.report.ends_run()) {
    if (state) write_file(*state, state_text(simulation.state()));
    tell_warnings(summary.warnings);
    return checks && !summary.warnings.empty() ? Outcome::check_failed : Outcome::ok;
  }
  print_early_end(simulation.n_steps(), summary.report,
                  frames ? "; the last finite frame is kept" : "");
  return Outcome::check_failed;
}

Outcome run_command(Arguments arguments) {
  RunOptions options;
  options.for_machines = arguments.flag("--json");
  options.checks = arguments.flag("--check");
  options.wants_drift = arguments.flag("--drift");
  Overwriting overwriting(arguments);
  if (const auto folder = arguments.text("--out")) options.out = Output{*folder};
  if (const auto folder = arguments.text("--dump")) options.dump = Dump{*folder};
  if (const auto file = arguments.text("--state")) options.state = *file;
  overwriting.need(options.out || options.dump || options.state, "--out, --dump or --state");
  const SceneInput input = take_scene(arguments);
  arguments.finish();
  overwriting.spare(input.files_read);
  return with_source_named(input, [&] { return run_scene(input.scene, options, overwriting); });
}

}  // namespace

extern const Command kRunCommand(
    "run", "SCENE.json", "compute a scene", run_command,
    {kFabricHelp, kMethodHelp, kTimeHelp, kJsonHelp},
    R"(  --out DIR              write frames and metrics.json into this folder, which holds none yet
  --dump DIR             write mass.mtx, stiffness_begin.mtx and stiffness_end.mtx (Matrix Market)
                         into this folder, which holds none yet
  --state FILE           write where the cloth is and how fast at the end, for a scene's "start"
  --check                exit status 1 when there is a warning: the run shows nonsense, or a step
                         did not converge
  --overwrite            remove or replace those of an earlier run
  --drift                account for the energy: what no force explains is the method's own
)");

}  // namespace pleat
