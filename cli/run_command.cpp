#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "cli/command_table.h"
#include "cli/overwriting.h"
#include "cli/progress.h"
#include "cli/scene_input.h"
#include "core/base/core_version.h"
#include "core/dynamics/stepper_table.h"
#include "core/error/self_crossings.h"
#include "core/files/frame_file.h"
#include "core/files/matrix_file.h"
#include "core/model/stretch.h"
#include "core/model/system_matrix.h"
#include "core/run/cloth_contact_metrics.h"
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
  SolveReport report;  // sum of all steps
  Stretch last_stretch;
  double largest_stretch = 0;
  double rms_stretch_sum = 0;       // all steps
  std::int64_t last_crossings = 0;  // the cloth with itself, where they are counted
  std::int64_t largest_crossings = 0;
  int n_frames = 0;
  std::vector<RunWarning> warnings;
  double unbalanced_share = 0;  // found by the last look; NaN: none came to rest
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

FrameMesh frame_mesh(const Simulation& simulation) {
  return {simulation.model().rest_coordinates, simulation.triangles()};
}

SelfCrossings crossings_of(const Simulation& simulation) {
  return {simulation.triangles(), simulation.rest_positions(), simulation.model().hanging};
}

/// Who watches a run, where it is asked for.
struct Watchers {
  std::optional<FrameWriter> frames;
  std::optional<SelfCrossings> crossings;
  std::optional<RunLedger> ledger;
};

/// Shows a mesh that a tear has changed to those who keep one.
void show_mesh(const Simulation& simulation, Watchers& watchers) {
  if (watchers.frames) watchers.frames->set_mesh(frame_mesh(simulation));
  if (watchers.crossings) watchers.crossings = crossings_of(simulation);
}

/// Hands a frame to everything that watches them.
void add_frame(const Simulation& simulation, Watchers& watchers, RunSummary& summary) {
  const Positions& positions = simulation.state().positions;
  if (watchers.frames) watchers.frames->write(positions, simulation.time());
  if (!watchers.crossings) return;
  summary.last_crossings = watchers.crossings->count(positions);
  summary.largest_crossings = std::max(summary.largest_crossings, summary.last_crossings);
}

/// Runs to the scene's end or until the numbers end it.
RunSummary run_to_end(Simulation& simulation, Watchers& watchers) {
  const Scene& scene = simulation.scene();
  const double step = scene.method.step;
  const std::int64_t n_steps = whole_steps(scene.duration, step);
  const std::int64_t steps_per_frame = whole_steps(scene.record.every, step);
  RunSummary summary;
  TimedRun run(simulation, TimedRun::Parts::untimed);
  RunWatch watch(simulation);
  Progress progress;
  add_frame(simulation, watchers, summary);
  if (scene.self_contact && summary.last_crossings > 0)
    std::fprintf(stderr,
                 "pleat: the cloth starts with %lld crossings of itself; self-contact keeps these, "
                 "and lets no other come\n",
                 static_cast<long long>(summary.last_crossings));
  std::int64_t topology = simulation.topology();
  while (simulation.n_steps() < n_steps) {
    const SolveReport step_report = run.step();
    if (std::exchange(topology, simulation.topology()) != topology) show_mesh(simulation, watchers);
    const bool ended = run.has_ended();
    summary.last_stretch = stretch(simulation.gauge(), simulation.state().positions);
    summary.largest_stretch = std::max(summary.largest_stretch, summary.last_stretch.largest);
    summary.rms_stretch_sum += summary.last_stretch.rms;
    watch.check(simulation, step_report);
    if (watchers.ledger) watchers.ledger->record_step();
    // The last finite frame of a run that ended early is kept, unless it was written already.
    const bool is_frame = (simulation.n_steps() % steps_per_frame == 0) != ended;
    if (is_frame) add_frame(simulation, watchers, summary);
    if (ended) break;
    progress.show(static_cast<double>(simulation.n_steps()) / static_cast<double>(n_steps),
                  scene.name);
  }
  summary.report = run.report();
  if (!run.has_ended()) watch.check_end(simulation);
  summary.warnings = watch.warnings();
  summary.unbalanced_share = watch.unbalanced_share();
  return summary;
}

Json drift_json(const EnergyLedger& ledger, bool meets_itself) {
  const EnergyLedger::Works& works = ledger.works();
  const EnergyParts& parts = ledger.parts();
  Json json = {{"drift_j", ledger.drift()},
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
  if (meets_itself) json["work_of_cloth_contact_j"] = works.cloth_contact;
  return json;
}

Json metrics_json(const Simulation& simulation, const RunSummary& summary, Watchers& watchers) {
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
               {"remark", simulation.stepper().remark()},
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
  json["unbalanced_share_at_rest"] = number_json(summary.unbalanced_share);
  json["warnings"] = json_warnings(summary.warnings);
  if (const StrainLimitPass* limit = simulation.stepper().strain_limit()) {
    json["strain_limit_sweeps_per_step"] = static_cast<double>(limit->n_sweeps()) / n_steps;
    json["n_strain_limit_capped"] = limit->n_capped();
  }
  if (watchers.crossings) {
    json["crossings_at_end"] = summary.last_crossings;
    json["largest_crossings"] = summary.largest_crossings;
  }
  // Empty for steppers that treat all springs alike.
  if (const auto springs = simulation.stepper().implicit_springs(); !springs.empty()) {
    std::string map;  // a 1 for each that is implicit, a 0 for others
    for (const char is_implicit : springs) map += is_implicit != 0 ? '1' : '0';
    const auto count = std::count(map.begin(), map.end(), '1');
    json["implicit_springs"] = {{"count", count},
                                {"all", map.size()},
                                {"share", static_cast<double>(count) / map.size()},
                                {"map", map}};
  }
  if (const auto bound = simulation.stability_bound()) json["stability_bound_s"] = *bound;
  if (const auto contact = simulation.stepper().first_contact()) json["first_contact_s"] = *contact;
  if (const ClothContact* contact = simulation.stepper().cloth_contact())
    json["cloth_contact"] = json_cloth_contact(*contact);
  if (watchers.ledger)
    json["energy"] = drift_json(watchers.ledger->account(), model.self_contact.has_value());
  json["core"] = core_version();
  return json;
}

std::string joined(const Json& words) {
  std::string text;
  for (const Json& word : words) text += (text.empty() ? "" : ", ") + word.get<std::string>();
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

void print_summary(const Simulation& simulation, const RunSummary& summary, const Json& metrics) {
  const Scene& scene = simulation.scene();
  std::printf("%s: %s, level %d, %d vertices, %s, step %.4g s x %d\n",
              printable(scene.name).c_str(), printable(scene.fabric.name).c_str(), scene.level,
              simulation.model().n_vertices(), scene.method.stepper->name, scene.method.step,
              simulation.substeps());
  std::printf("built: %s\nleft out: %s\n", joined(metrics["built"]).c_str(),
              joined(metrics["left_out"]).c_str());
  std::printf("%lld steps to %.10g s, status %s\n", static_cast<long long>(simulation.n_steps()),
              simulation.time(), name(summary.report.status));
  std::printf("stretch at the end: rms %.3g %%, largest %.3g %%; largest of all %.3g %%\n",
              100 * summary.last_stretch.rms, 100 * summary.last_stretch.largest,
              100 * summary.largest_stretch);
  if (std::isfinite(summary.unbalanced_share))
    std::printf("at rest, %.3g %% of the weight is unbalanced\n", 100 * summary.unbalanced_share);
  if (const std::string remark = simulation.stepper().remark(); !remark.empty())
    std::printf("method: %s\n", remark.c_str());
  if (!summary.report.message.empty() && !summary.report.ends_run())
    std::printf("%s\n", summary.report.message.c_str());
  std::printf("largest residual %.3g\n", summary.report.relative_residual);
  if (const auto springs = metrics.find("implicit_springs"); springs != metrics.end())
    std::printf("implicit springs: %d of %d, %.3g %%\n", springs->at("count").get<int>(),
                springs->at("all").get<int>(), 100 * springs->at("share").get<double>());
  if (const auto contact = simulation.stepper().first_contact())
    std::printf("first contact at %.10g s\n", *contact);
  if (scene.model.tearing)
    std::printf("tears: %zu vertices were split\n", simulation.tear_origins().size());
  if (const auto contact = metrics.find("cloth_contact"); contact != metrics.end())
    std::printf(
        "cloth contact: %d pairs near and %d touching at the end, %.2g %% of the vertices "
        "held back, %.2g mm of motion lost in a substep\n",
        contact->at("n_pairs").get<int>(), contact->at("n_touching").get<int>(),
        100 * contact->at("held_back_share").get<double>(),
        1e3 * contact->at("rms_motion_lost_m").get<double>());
  if (metrics.contains("crossings_at_end"))
    std::printf("crossings of the cloth with itself: %lld in the last frame, at most %lld\n",
                static_cast<long long>(summary.last_crossings),
                static_cast<long long>(summary.largest_crossings));
  if (const auto energy = metrics.find("energy"); energy != metrics.end())
    std::printf("energy drift %.3g J, %.3g %% of the largest kinetic energy\n",
                energy->at("drift_j").get<double>(),
                100 * energy->at("share_of_largest_kinetic_energy").get<double>());
}

Outcome run_command(Arguments arguments) {
  const bool for_machines = arguments.flag("--json");
  const bool checks = arguments.flag("--check");
  const bool wants_drift = arguments.flag("--drift");
  FrameFolder out(arguments, "metrics.json");
  Overwriting& overwriting = out.overwriting();
  std::optional<Dump> dump;
  if (const auto folder = arguments.text("--dump")) dump = Dump{*folder};
  const auto state = arguments.text("--state");
  overwriting.need(out || dump || state, "--out, --dump or --state");
  const SceneInput input = take_scene(arguments);
  const Scene& scene = input.scene;
  overwriting.spare(input.files_read);
  return with_source_named(input, [&] {
    if (out) check_frame_count(scene);
    if (dump || state) expect_whole(scene);
    Simulation simulation(scene);
    if (dump) dump->prepare(overwriting);
    if (state) overwriting.check(*state);
    out.prepare();
    if (!for_machines || chooses_substeps(scene)) print_beginning(simulation);
    if (dump) {
      write_file(dump->mass, matrix_market_text(mass_matrix(simulation.model())));
      write_stiffness(simulation, dump->stiffness_begin);
    }
    Watchers watchers;
    if (out) watchers.frames.emplace(out.open(scene.record.format, frame_mesh(simulation)));
    if (out || scene.cloth->is_worn() || scene.self_contact)
      watchers.crossings = crossings_of(simulation);
    if (wants_drift) watchers.ledger.emplace(simulation);
    RunSummary summary = run_to_end(simulation, watchers);
    if (out) watchers.frames->finish();
    if (out) summary.n_frames = watchers.frames->n_frames();
    const Json metrics = metrics_json(simulation, summary, watchers);
    if (for_machines)
      std::printf("%s\n", metrics.dump().c_str());
    else
      print_summary(simulation, summary, metrics);
    if (out) write_file(out.other_file(), format_json(metrics));
    if (dump) write_stiffness(simulation, dump->stiffness_end);
    if (!summary.report.ends_run()) {
      const State& end = simulation.state();
      if (state) write_file(*state, json_start({end.positions, end.velocities, 0}).dump() + '\n');
      tell_warnings(summary.warnings);
      return checks && !summary.warnings.empty() ? Outcome::check_failed : Outcome::ok;
    }
    print_early_end(simulation.n_steps(), summary.report,
                    out ? "; the last finite frame is kept" : "");
    return Outcome::check_failed;
  });
}

}  // namespace

extern const Command kRunCommand(
    "run", "SCENE.json", "compute a scene", run_command,
    {kFabricHelp, kMethodHelp, kTimeHelp, kJsonHelp},
    R"(  --out DIR              write frames and metrics.json into this folder, which holds none yet
  --dump DIR             write mass.mtx, stiffness_begin.mtx and stiffness_end.mtx (Matrix Market)
                         into this folder, which holds none yet
  --state FILE           write where the cloth is and how fast at the end, to the last digit, for a
                         scene's "start"
  --check                exit status 1 when there is a warning: the run shows nonsense, a step did
                         not converge and left more than a thousandth of its equations, or cloth
                         rests where its forces do not balance
  --overwrite            remove or replace those of an earlier run
  --drift                account for the energy: what no force explains is the method's own
)");

}  // namespace pleat
