#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/progress.h"
#include "cli/scene_input.h"
#include "core/scene/whole_file.h"
#include "core/dynamics/system_matrix.h"
#include "core/measure/core_version.h"
#include "core/measure/energy_ledger.h"
#include "core/measure/error_norms.h"
#include "core/scene/frame_file.h"
#include "core/scene/matrix_file.h"
#include "core/scene/method_section.h"
#include "core/scene/scene_model.h"
#include "core/scene/simulation.h"

namespace pleat {
namespace {

/// What a whole run showed.
struct RunSummary {
  SolveReport report;  // of the worst step; residual the largest, iterations the sum
  Stretch last_stretch;
  double largest_stretch = 0;
  double rms_stretch_sum = 0;  // over steps
  int n_frames = 0;
};

bool has_ended(const SolveReport& report) {
  return !report.ok() && report.status != SolveStatus::not_converged;
}

void write_stiffness(const Simulation& simulation, const std::filesystem::path& path) {
  write_file(path, matrix_market_text(stiffness_matrix(
                       simulation.model(), simulation.state().positions, SpringHessian::exact)));
}

void add_step(const Simulation& simulation, SolveReport report, RunSummary& summary) {
  summary.report.iterations += report.iterations;
  summary.report.relative_residual =
      std::max(summary.report.relative_residual, report.relative_residual);
  if (!report.ok()) {
    summary.report.status = report.status;
    summary.report.message = std::move(report.message);
  }
  summary.last_stretch = stretch(simulation.model().springs, simulation.state().positions);
  summary.largest_stretch = std::max(summary.largest_stretch, summary.last_stretch.largest);
  summary.rms_stretch_sum += summary.last_stretch.rms;
}

/// Runs to the scene's end or until the numbers end it. `frames` and `ledger` may be null.
RunSummary run_to_end(Simulation& simulation, FrameWriter* frames, EnergyLedger* ledger) {
  const Scene& scene = simulation.scene();
  const double step = scene.method.step;
  const auto n_steps = std::max<std::int64_t>(1, std::llround(scene.duration / step));
  const auto steps_per_frame = std::max<std::int64_t>(1, std::llround(scene.record.every / step));
  RunSummary summary;
  Progress progress;
  State begin;
  if (frames != nullptr) frames->write(simulation.state().positions, 0);
  while (simulation.n_steps() < n_steps) {
    if (ledger != nullptr) begin = simulation.state();
    const SolveReport report = simulation.step();
    const bool ended = has_ended(report);
    add_step(simulation, report, summary);
    if (ledger != nullptr && !ended)
      ledger->record(begin, simulation.state(), simulation.time(), step);
    // The last finite frame of a run that ended early is kept, unless it was written already.
    const bool is_frame = (simulation.n_steps() % steps_per_frame == 0) != ended;
    if (frames != nullptr && is_frame)
      frames->write(simulation.state().positions, simulation.time());
    if (ended) break;
    progress.show(static_cast<double>(simulation.n_steps()) / static_cast<double>(n_steps),
                  scene.name);
  }
  return summary;
}

Json drift_json(const EnergyLedger& ledger) {
  const EnergyLedger::Works& works = ledger.works();
  return {{"drift_j", ledger.drift()},
          {"share_of_largest_kinetic_energy", ledger.relative_drift()},
          {"energy_j", ledger.energy()},
          {"work_of_damping_j", works.damping},
          {"work_of_air_j", works.air},
          {"work_of_pins_j", works.pins},
          {"work_of_contact_j", works.contact}};
}

Json metrics_json(const Simulation& simulation, const RunSummary& summary,
                  const EnergyLedger* ledger) {
  const Scene& scene = simulation.scene();
  const ClothModel& model = simulation.model();
  const BuildReport built = build_report(model);
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
               {"left_out", built.left_out},
               {"status", name(summary.report.status)},
               {"message", summary.report.message},
               {"n_steps", simulation.n_steps()},
               {"time_s", simulation.time()},
               {"n_frames", summary.n_frames},
               {"iterations_per_step", summary.report.iterations / n_steps},
               {"largest_residual", summary.report.relative_residual},
               {"rms_stretch_at_end", summary.last_stretch.rms},
               {"largest_stretch_at_end", summary.last_stretch.largest},
               {"mean_rms_stretch", summary.rms_stretch_sum / n_steps},
               {"largest_stretch", summary.largest_stretch}};
  if (ledger != nullptr) json["energy"] = drift_json(*ledger);
  json["core"] = core_version();
  return json;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text.empty() ? "nothing" : text;
}

void print_summary(const Simulation& simulation, const RunSummary& summary,
                   const EnergyLedger* ledger) {
  const Scene& scene = simulation.scene();
  const BuildReport built = build_report(simulation.model());
  std::printf("%s: %s, level %d, %d vertices, %s, step %.4g s x %d\n", scene.name.c_str(),
              scene.fabric.name.c_str(), scene.level, simulation.model().n_vertices(),
              name(scene.method.stepper), scene.method.step, simulation.substeps());
  std::printf("built: %s\nleft out: %s\n", joined(built.built).c_str(),
              joined(built.left_out).c_str());
  std::printf("%lld steps to %.4g s, status %s\n", static_cast<long long>(simulation.n_steps()),
              simulation.time(), name(summary.report.status));
  std::printf("stretch at the end: rms %.3g %%, largest %.3g %%; largest of all %.3g %%\n",
              100 * summary.last_stretch.rms, 100 * summary.last_stretch.largest,
              100 * summary.largest_stretch);
  std::printf("largest residual %.3g\n", summary.report.relative_residual);
  if (ledger != nullptr)
    std::printf("energy drift %.3g J, %.3g %% of the largest kinetic energy\n", ledger->drift(),
                100 * ledger->relative_drift());
}

}  // namespace

Outcome run_command(Arguments arguments) {
  const bool for_machines = arguments.flag("--json");
  const bool wants_drift = arguments.flag("--drift");
  const auto out = arguments.text("--out");
  const auto dump = arguments.text("--dump");
  const SceneInput input = take_scene(arguments);
  const Scene& scene = input.scene;
  arguments.finish();
  const auto built =
      with_file_named(input.file, [&] { return std::make_unique<Simulation>(scene); });
  Simulation& simulation = *built;

  if (dump) {
    make_folder(*dump);
    write_file(std::filesystem::path(*dump) / "mass.mtx",
               matrix_market_text(mass_matrix(simulation.model())));
    write_stiffness(simulation, std::filesystem::path(*dump) / "stiffness_begin.mtx");
  }
  std::optional<FrameWriter> frames;
  if (out) {
    make_folder(*out);
    frames.emplace(*out, scene.record.format,
                   FrameMesh{simulation.model().rest_coordinates, simulation.triangles()});
  }
  std::optional<EnergyLedger> ledger;
  if (wants_drift) ledger.emplace(simulation.model(), simulation.state());
  RunSummary summary =
      run_to_end(simulation, frames ? &*frames : nullptr, ledger ? &*ledger : nullptr);
  if (frames) summary.n_frames = frames->n_frames();
  if (dump) write_stiffness(simulation, std::filesystem::path(*dump) / "stiffness_end.mtx");

  const Json metrics = metrics_json(simulation, summary, ledger ? &*ledger : nullptr);
  if (out) write_file(std::filesystem::path(*out) / "metrics.json", format_json(metrics) + "\n");
  if (for_machines)
    std::printf("%s\n", metrics.dump().c_str());
  else
    print_summary(simulation, summary, ledger ? &*ledger : nullptr);
  if (!has_ended(summary.report)) return Outcome::ok;
  std::fprintf(stderr, "pleat: stopped in step %lld: %s; the last finite frame is kept\n",
               static_cast<long long>(simulation.n_steps() + 1), summary.report.message.c_str());
  return Outcome::check_failed;
}

}  // namespace pleat
