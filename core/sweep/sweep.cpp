#include "core/sweep/sweep.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/check.h"
#include "core/base/core_version.h"
#include "core/dynamics/stepper_table.h"
#include "core/error/error_norms.h"
#include "core/error/run_comparison.h"
#include "core/files/json_reader.h"
#include "core/scene/cloth_section.h"
#include "core/scene/fabric_section.h"
#include "core/scene/method_section.h"
#include "core/scene/model_section.h"
#include "core/sweep/platform.h"

namespace pleat {
namespace {

constexpr double kFrame = 1.0 / 60;  // [s]

constexpr double kUncertaintyShare = 4;  // an error is known when it is so many times as large

std::string unconverged_sentence(double distance, double uncertainty) {
  char sentence[160];
  std::snprintf(sentence, sizeof sentence,
                "no position error: %.3g mm from the reference, which itself changes by %.3g mm "
                "when its step or mesh is halved",
                1e3 * distance, 1e3 * uncertainty);
  return sentence;
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

/// Errors of a run that reached its last sample against a reference that did too. Where the
/// reference itself is not known four times as well, there is no position error.
void compare(const SampledRun& run, const Scene& reference_scene, const Reference& reference,
             BenchRow& row) {
  const Stretch own = overall_stretch(run.samples());
  row.rms_stretch = own.rms;
  row.largest_stretch = own.largest;
  if (reference.samples.size() != run.samples().size()) return;
  const Scene& scene = run.simulation().scene();
  const RunComparison comparison = scene.plan || reference_scene.plan
                                       ? RunComparison(scene, reference_scene)
                                       : RunComparison(scene, reference_scene.level);
  const RunErrors errors = comparison.errors(run.samples(), reference.samples);
  row.surface_error = errors.surface_rms;
  row.surface_error_95 = errors.surface_95;
  row.bend_error = errors.bend_distribution;
  row.bend_error_of_regions = errors.bend_regions;
  const Stretch theirs = overall_stretch(reference.samples);
  row.rms_stretch_error = own.rms - theirs.rms;
  row.largest_stretch_error = own.largest - theirs.largest;
  const double uncertainty = reference.label.uncertainty;
  if (errors.position < kUncertaintyShare * uncertainty) {
    row.reference.converged = false;
    if (row.message.empty()) row.message = unconverged_sentence(errors.position, uncertainty);
    return;
  }
  row.position_error = errors.position;
  row.position_error_95 = errors.position_95;
  const double diagonal = scene.cloth->rest_diagonal();
  if (diagonal > 0) row.position_error_percent = 100 * row.position_error / diagonal;
}

/// A row whose run reached its end and took measurable time.
bool can_be_timed(const BenchRow& row) { return row.finished() && row.ms_per_frame > 0; }

double ms_per_frame(double seconds, double simulated) { return 1e3 * seconds * kFrame / simulated; }

/// For progress alone: vertices times substeps times their cost, per second of motion.
double expected_work(double n_vertices, const MethodOptions& method) {
  constexpr int kStableSubsteps = 100;  // of explicit, where the stability bound chooses
  const int substeps = method.substeps > 0 ? method.substeps : kStableSubsteps;
  return n_vertices / method.step * substeps * method.stepper->substep_cost(method);
}

double expected_work(const Scene& scene) {
  const auto n_vertices = static_cast<double>(scene.cloth->n_vertices(scene.level));
  return expected_work(n_vertices, scene.method);
}

std::string phrase(const MethodOptions& method, int level) {
  return std::string(method.stepper->name) + ", level " + std::to_string(level);
}

Json journal_line(std::size_t setting, std::size_t round) {
  return {{"setting", setting}, {"round", round}};
}

}  // namespace

std::string sweep_identity(const SweepPlan& plan, const std::string& commit) {
  Json references = Json::array();  // their ids hold what the plan only names
  for (const ReferenceRecipe& recipe : sweep_references(plan).recipes)
    references.push_back(recipe.id);
  return format_json({{"core", core_version()},
                      {"commit", commit},
                      {"references", references},
                      {"plan", json_sweep_plan(plan)}});
}

Sweep::Sweep(SweepPlan plan, ReferenceStore& store, std::string commit)
    : plan_(std::move(plan)),
      store_(store),
      commit_(std::move(commit)),
      times_(sweep_sample_times(plan_.duration)),
      references_(sweep_references(plan_)),
      made_(references_.recipes.size()),
      run_times_(plan_.settings.size()) {
  PLEAT_CHECK(!plan_.settings.empty() && plan_.n_repeats >= 1,
              "a sweep has settings and runs them");
}

bool Sweep::run_is_left_out() const {
  return !done() && !in_first_round() && !can_be_timed(rows_[setting()]);
}

void Sweep::skip_left_out() {
  while (run_is_left_out()) ++n_done_;
}

/// The first reference that a setting without a row needs.
std::optional<std::size_t> Sweep::missing_reference() const {
  for (std::size_t s = rows_.size(); s < n_settings(); ++s)
    if (const std::size_t recipe = references_.of_setting[s]; !made_[recipe]) return recipe;
  return std::nullopt;
}

void Sweep::make_reference(std::size_t recipe, double budget) {
  const std::string& id = references_.recipes[recipe].id;
  if (maker_ == nullptr) {
    made_[recipe] = store_.find(id);
    if (made_[recipe]) return;
  }
  try {
    if (maker_ == nullptr) maker_ = make_reference_maker(references_.recipes[recipe], times_);
    maker_->advance(budget);
  } catch (const InputError& error) {
    throw InputError("/scene" + error.where(), error.what());
  }
  if (!maker_->done()) return;
  made_[recipe] = maker_->reference();
  PLEAT_CHECK(made_[recipe]->label.id == id, "a reference has the id of its recipe");
  const bool is_whole = made_[recipe]->samples.size() == times_.size();
  if (is_whole) store_.keep(*made_[recipe]);
  maker_.reset();
}

BenchRow Sweep::new_row(const Scene& scene) const {
  BenchRow row(made_[references_.of_setting[setting()]]->label);
  row.scene = scene.name;
  row.setting = plan_.settings[setting()].changes;
  row.fabric = json_fabric(scene);
  row.model = json_model(scene.model);
  row.method = scene.method;
  row.level = scene.level;
  row.target = build_target();
  row.commit = commit_;
  return row;
}

BenchRow Sweep::measured_row() const {
  const Simulation& simulation = run_->simulation();
  const SolveReport& report = run_->report();
  BenchRow row = new_row(simulation.scene());
  row.n_vertices = simulation.model().n_vertices();
  row.n_substeps = simulation.substeps();
  row.status = name(report.status);
  row.message = report.message;
  if (report.relative_residual > 0) row.residual = report.relative_residual;  // else not computed
  row.energy_drift = run_->relative_drift();
  if (simulation.model().contact)
    row.n_unresolved_contacts = static_cast<int>(simulation.model().contact->n_unresolved());
  if (simulation.n_steps() > 0)
    row.iterations_per_step = report.iterations / static_cast<double>(simulation.n_steps());
  if (run_->timed_duration() > 0) {
    row.ms_per_frame = ms_per_frame(run_->timed_seconds(), run_->timed_duration());
    row.parts_ms = run_->parts().mean_ms(run_->timed_duration() / kFrame);
  }
  const std::size_t recipe = references_.of_setting[setting()];
  if (!run_->failed()) compare(*run_, references_.recipes[recipe].scene, *made_[recipe], row);
  row.process_peak_memory = process_peak_memory();
  return row;
}

void Sweep::keep_row(BenchRow row) {
  rows_.push_back(std::move(row));
  ++n_done_;
}

void Sweep::keep_time(double ms_per_frame) {
  std::vector<double>& times = run_times_[setting()];
  times.push_back(ms_per_frame);
  const auto [quickest, slowest] = std::minmax_element(times.begin(), times.end());
  BenchRow& row = rows_[setting()];
  row.ms_per_frame = median(times);
  row.spread_ms = *slowest - *quickest;
  row.n_runs = static_cast<int>(times.size());
  ++n_done_;
}

/// The row of a setting that cannot run, else the run at hand.
std::optional<BenchRow> Sweep::begin_run() {
  const auto parts =
      in_first_round() ? SampledRun::Parts::timed_with_ledger : SampledRun::Parts::untimed;
  const Scene scene = plan_.scene_of(setting());
  try {
    run_ = std::make_unique<SampledRun>(scene, times_, parts);
    return std::nullopt;
  } catch (const InputError& error) {
    if (!in_first_round()) throw;
    BenchRow row = new_row(scene);
    row.status = "refused";
    row.message = error.where() + ": " + error.what();
    return row;
  }
}

void Sweep::record_row(BenchRow row) {
  Json line = journal_line(setting(), round());
  line["row"] = json_bench_row(row);
  record_(line.dump() + "\n");
  keep_row(std::move(row));
}

void Sweep::record_time(double ms_per_frame) {
  Json line = journal_line(setting(), round());
  line["ms_per_frame"] = ms_per_frame;
  record_(line.dump() + "\n");
  keep_time(ms_per_frame);
}

void Sweep::work_on_run(double budget) {
  if (run_ == nullptr)
    if (std::optional<BenchRow> refused = begin_run()) return record_row(std::move(*refused));
  run_->advance(budget);
  if (!run_->done()) return;
  if (in_first_round())
    record_row(measured_row());
  else
    record_time(ms_per_frame(run_->timed_seconds(), run_->timed_duration()));
  run_.reset();
}

void Sweep::advance(double budget) {
  const Stopwatch watch;
  while (!done()) {
    const double left = budget - watch.elapsed();
    if (const auto recipe = missing_reference())
      make_reference(*recipe, left);
    else
      work_on_run(left);
    skip_left_out();
    if (watch.elapsed() >= budget) return;
  }
}

/// False for a line that is not the next one of this sweep.
bool Sweep::take_line(std::string_view text) {
  try {
    const Json json = parse_json(text);
    const JsonReader line(json);
    const auto most = static_cast<std::int64_t>(n_runs());
    if (line.at("setting").integer(0, most) != static_cast<std::int64_t>(setting()) ||
        line.at("round").integer(0, most) != static_cast<std::int64_t>(round()))
      return false;
    if (!in_first_round()) {
      keep_time(line.at("ms_per_frame").number(kNotNegative));
      return true;
    }
    BenchRow row = read_bench_row(line.at("row"), plan_.steppers);
    if (row.reference.id != references_.recipes[references_.of_setting[setting()]].id) return false;
    keep_row(std::move(row));
    return true;
  } catch (const InputError&) {
    return false;
  }
}

std::size_t Sweep::resume(std::string_view journal) {
  PLEAT_CHECK(n_done_ == 0 && maker_ == nullptr && run_ == nullptr, "only a new sweep resumes");
  std::size_t taken = 0;
  while (!done()) {
    const std::size_t end = journal.find('\n', taken);
    if (end == std::string_view::npos || !take_line(journal.substr(taken, end - taken))) break;
    taken = end + 1;
    skip_left_out();
  }
  return taken;
}

double Sweep::progress() const {
  double sum = 0;
  double passed = 0;
  const auto add = [&](double work, double n_runs, double n_passed) {
    sum += work * n_runs;
    passed += work * n_passed;
  };
  const std::optional<std::size_t> missing = missing_reference();
  for (std::size_t r = 0; r < made_.size(); ++r) {
    const double at_hand = r == missing && maker_ != nullptr ? maker_->progress() : 0;
    add(expected_work(references_.recipes[r].scene), 1, made_[r] || !missing ? 1 : at_hand);
  }
  for (std::size_t s = 0; s < n_settings(); ++s) {
    const double at_hand = s == setting() && run_ != nullptr ? run_->progress() : 0;
    add(expected_work(plan_.settings[s].n_vertices, plan_.settings[s].method),
        1.0 + plan_.n_repeats, static_cast<double>(round() + (s < setting() ? 1 : 0)) + at_hand);
  }
  return passed / sum;
}

std::string Sweep::message() const {
  if (done()) return "";
  if (const auto recipe = missing_reference()) {
    const Scene& scene = references_.recipes[*recipe].scene;
    const std::string which =
        made_.size() == 1 ? ""
                          : std::to_string(*recipe + 1) + " of " + std::to_string(made_.size());
    return "reference" + (which.empty() ? "" : " " + which) + ": " +
           phrase(scene.method, scene.level);
  }
  const SweepSetting& at_hand = plan_.settings[setting()];
  return phrase(at_hand.method, at_hand.level) +
         (in_first_round() ? ""
                           : ", timed run " + std::to_string(round()) + " of " +
                                 std::to_string(plan_.n_repeats));
}

Json Sweep::report() const {
  Json rows = Json::array();
  for (const BenchRow& row : rows_) rows.push_back(json_bench_row(row));
  return {{"done", done()},
          {"progress", progress()},
          {"rows", rows},
          {"front", front_of(rows_)},
          {"message", message()}};
}

}  // namespace pleat
