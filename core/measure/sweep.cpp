#include "core/measure/sweep.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/measure/chain_reference.h"
#include "core/measure/platform.h"
#include "core/scene/json_text.h"

namespace pleat {
namespace {

constexpr double kFrame = 1.0 / 60;  // [s]

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// Over the sample times: RMS of the RMS, largest of the largest.
Stretch overall_stretch(const std::vector<Sample>& samples) {
  Stretch overall;
  std::vector<double> values;
  for (const Sample& sample : samples) {
    values.push_back(sample.stretch.rms);
    overall.largest = std::max(overall.largest, sample.stretch.largest);
  }
  overall.rms = root_mean_square(values);
  return overall;
}

/// Errors of a run that reached its last sample against a reference that did too.
void compare(const SampledRun& run, const Reference& reference, BenchRow& row) {
  const Stretch own = overall_stretch(run.samples());
  row.rms_stretch = own.rms;
  row.largest_stretch = own.largest;
  if (reference.samples.size() != run.samples().size()) return;
  const Eigen::VectorXd areas = run.simulation().rest_areas();
  std::vector<double> errors;
  for (std::size_t s = 0; s < run.samples().size(); ++s)
    errors.push_back(
        position_error(run.samples()[s].positions, reference.samples[s].positions, areas));
  row.position_error = root_mean_square(errors);
  const double diagonal = rest_diagonal(run.simulation().scene());
  if (diagonal > 0) row.position_error_percent = 100 * row.position_error / diagonal;
  const Stretch theirs = overall_stretch(reference.samples);
  row.rms_stretch_error = own.rms - theirs.rms;
  row.largest_stretch_error = own.largest - theirs.largest;
}

/// A row whose run reached its end and took measurable time.
bool can_be_timed(const BenchRow& row) { return row.finished() && row.ms_per_frame > 0; }

double ms_per_frame(double seconds, double simulated) { return 1e3 * seconds * kFrame / simulated; }

/// What a substep costs per vertex, roughly, in units of what the forces of explicit cost.
double substep_cost(const MethodOptions& method) {
  switch (method.stepper) {
    case StepperKind::explicit_euler:
      return 1;
    case StepperKind::implicit_euler:
      if (method.solver == SolverKind::cg) return 80;  // some ten products with a 3x3-block matrix
      return 300;                                      // a factorisation
    case StepperKind::projective:
      return 10 * method.iterations;  // a kept factor's two triangular solves a round
    case StepperKind::xpbd:
      return 0.2 * method.iterations;  // float32, four springs at a time, no forces
  }
  return 1;
}

/// For progress alone: vertices times substeps times their cost.
double expected_run_work(const Scene& scene) {
  constexpr int kStableSubsteps = 100;  // of explicit, where the stability bound chooses
  double vertices = 1;
  if (const auto* sheet = std::get_if<SheetShape>(&scene.cloth))
    vertices = std::ldexp(sheet->rows, scene.level) * std::ldexp(sheet->columns, scene.level);
  const MethodOptions& method = scene.method;
  const int substeps = method.substeps > 0 ? method.substeps : kStableSubsteps;
  return vertices / method.step * substeps * substep_cost(method);
}

std::string phrase(const Scene& scene) {
  return std::string(name(scene.method.stepper)) + ", level " + std::to_string(scene.level);
}

}  // namespace

Sweep::Sweep(SweepPlan plan, ReferenceStore& store, std::string commit)
    : plan_(std::move(plan)),
      store_(store),
      commit_(std::move(commit)),
      times_(sweep_sample_times(plan_.duration)),
      run_times_(static_cast<std::size_t>(plan_.n_settings())) {
  PLEAT_CHECK(!plan_.levels.empty() && !plan_.methods.empty() && plan_.n_repeats >= 1,
              "a sweep has settings and runs them");
}

std::size_t Sweep::setting() const {
  return static_cast<std::size_t>((n_done_ - 1) % plan_.n_settings());
}

Scene Sweep::setting_scene(std::size_t setting) const {
  Scene scene = plan_.scene;
  scene.level = plan_.levels[setting / plan_.methods.size()];
  scene.method = plan_.methods[setting % plan_.methods.size()];
  return scene;
}

void Sweep::make_reference(double budget) {
  if (plan_.reference == ReferenceKind::rigid_chain) {
    reference_ = chain_reference(finest_scene(plan_), times_);
    ++n_done_;
    return;
  }
  const Scene scene = finest_scene(plan_);
  const std::string id = reference_id("finest", scene, times_);
  if (run_ == nullptr) {
    if (std::optional<Reference> known = store_.find(id)) {
      reference_ = std::move(*known);
      ++n_done_;
      return;
    }
    run_ = std::make_unique<SampledRun>(scene, times_, SampledRun::Parts::untimed);
  }
  run_->advance(budget);
  if (!run_->done()) return;
  reference_.label = {id,
                      "implicit with " + std::string(name(scene.method.solver)) + ", level " +
                          std::to_string(scene.level) + ", step " + step_phrase(scene.method.step),
                      false};
  reference_.samples = run_->samples();
  if (run_->failed())
    reference_.label.description += ", which ended early: " + run_->report().message;
  else
    store_.keep(reference_);
  run_.reset();
  ++n_done_;
}

BenchRow Sweep::new_row() const {
  const Scene scene = setting_scene(setting());
  BenchRow row(reference_.label);
  row.scene = scene.name;
  row.method = scene.method;
  row.level = scene.level;
  row.target = build_target();
  row.commit = commit_;
  return row;
}

BenchRow Sweep::measured_row() const {
  const Simulation& simulation = run_->simulation();
  const SolveReport& report = run_->report();
  BenchRow row = new_row();
  row.n_vertices = simulation.model().n_vertices();
  row.n_substeps = simulation.substeps();
  row.status = name(report.status);
  row.message = report.message;
  row.residual = report.relative_residual;
  row.energy_drift = run_->relative_drift();
  if (simulation.model().contact)
    row.n_unresolved_contacts = static_cast<int>(simulation.model().contact->n_unresolved());
  if (simulation.n_steps() > 0)
    row.iterations_per_step = report.iterations / static_cast<double>(simulation.n_steps());
  if (run_->timed_duration() > 0) {
    row.ms_per_frame = ms_per_frame(run_->timed_seconds(), run_->timed_duration());
    for (int s = 0; s < kStageCount; ++s)
      row.parts_ms[static_cast<std::size_t>(s)] =
          ms_per_frame(run_->parts().total(static_cast<Stage>(s)), run_->timed_duration());
  }
  if (!run_->failed()) compare(*run_, reference_, row);
  row.process_peak_memory = process_peak_memory();
  return row;
}

void Sweep::add_time() {
  std::vector<double>& times = run_times_[setting()];
  times.push_back(ms_per_frame(run_->timed_seconds(), run_->timed_duration()));
  const auto [quickest, slowest] = std::minmax_element(times.begin(), times.end());
  BenchRow& row = rows_[setting()];
  row.ms_per_frame = median(times);
  row.spread_ms = *slowest - *quickest;
  row.n_runs = static_cast<int>(times.size());
}

void Sweep::begin_run() {
  const auto parts =
      in_first_round() ? SampledRun::Parts::timed_with_ledger : SampledRun::Parts::untimed;
  try {
    run_ = std::make_unique<SampledRun>(setting_scene(setting()), times_, parts);
  } catch (const InputError& error) {
    BenchRow row = new_row();
    row.status = "refused";
    row.message = error.where() + ": " + error.what();
    rows_.push_back(std::move(row));
    ++n_done_;
  }
}

void Sweep::work_on_setting(double budget) {
  if (run_ == nullptr && !in_first_round() && !can_be_timed(rows_[setting()])) {
    ++n_done_;
    return;
  }
  if (run_ == nullptr) begin_run();
  if (run_ == nullptr) return;
  run_->advance(budget);
  if (!run_->done()) return;
  if (in_first_round())
    rows_.push_back(measured_row());
  else
    add_time();
  run_.reset();
  ++n_done_;
}

void Sweep::advance(double budget) {
  const Stopwatch watch;
  while (!done()) {
    const double left = budget - watch.elapsed();
    if (in_reference())
      make_reference(left);
    else
      work_on_setting(left);
    if (watch.elapsed() >= budget) return;
  }
}

double Sweep::expected_work(int task) const {
  return expected_run_work(
      task == 0 ? finest_scene(plan_)
                : setting_scene(static_cast<std::size_t>((task - 1) % plan_.n_settings())));
}

double Sweep::progress() const {
  double sum = 0;
  double passed = 0;
  for (int task = 0; task < n_tasks(); ++task) {
    const double work = expected_work(task);
    sum += work;
    if (task < n_done_) passed += work;
    if (task == n_done_ && run_ != nullptr) passed += work * run_->progress();
  }
  return passed / sum;
}

std::string Sweep::message() const {
  if (done()) return "";
  if (in_reference()) return "reference: " + phrase(finest_scene(plan_));
  const int round = (n_done_ - 1) / plan_.n_settings();
  return phrase(setting_scene(setting())) +
         (round == 0
              ? ""
              : ", timed run " + std::to_string(round) + " of " + std::to_string(plan_.n_repeats));
}

std::string Sweep::report_json() const {
  Json rows = Json::array();
  for (const BenchRow& row : rows_) rows.push_back(parse_json(write_bench_row(row)));
  return Json{{"done", done()},
              {"progress", progress()},
              {"rows", rows},
              {"front", front_of(rows_)},
              {"message", message()}}
      .dump();
}

}  // namespace pleat
