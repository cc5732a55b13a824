#include "core/sweep/sweep.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/check.h"
#include "core/base/core_version.h"
#include "core/dynamics/stepper_table.h"
#include "core/error/error_norms.h"
#include "core/files/json_reader.h"
#include "core/scene/format/fabric_section.h"
#include "core/scene/format/method_section.h"
#include "core/scene/format/model_section.h"
#include "core/sweep/platform.h"
#include "core/sweep/row_errors.h"

namespace pleat {
namespace {

constexpr double kFrame = 1.0 / 60;  // [s]

constexpr double kTellingShare = 0.05;  // share of a run: less says nothing of how long it takes

/// A row whose run reached its end and took measurable time.
bool can_be_timed(const BenchRow& row) { return row.finished() && row.ms_per_frame > 0; }

double ms_per_frame(double seconds, double simulated) { return 1e3 * seconds * kFrame / simulated; }

/// Relative cost of a vertex on a mesh of so many: a system that is solved at once takes about
/// seven times as long with four times the vertices (81 to 4225 of them, in all three scenes).
double solving_factor(double n_vertices, const MethodOptions& method) {
  constexpr double kExponent = 0.4;  // log(7)/log(4) - 1
  constexpr double kUsual = 1000;    // vertices, where a substep costs what its row says
  return method.stepper->solves_whole_substeps ? std::pow(n_vertices / kUsual, kExponent) : 1;
}

/// Substeps times vertices times their cost, per second of motion; for progress and estimates.
double expected_work(double n_vertices, const MethodOptions& method) {
  constexpr int kUsualSubsteps =
      100;  // usual number for explicit, where the stability bound chooses
  const int substeps = method.substeps == kStableSubsteps ? kUsualSubsteps : method.substeps;
  return n_vertices / method.step * substeps * method.stepper->substep_cost(method) *
         solving_factor(n_vertices, method);
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
      is_needed_(references_.recipes.size(), true),
      run_times_(plan_.settings.size()),
      reference_seconds_(references_.recipes.size()),
      row_seconds_(plan_.settings.size()) {
  PLEAT_CHECK(!plan_.settings.empty() && plan_.n_repeats >= 1,
              "a sweep has settings and runs them");
}

bool Sweep::run_is_left_out() const {
  return !done() && !in_first_round() && !can_be_timed(rows_[setting()]);
}

/// Takes what the store has. A finer one that is there needs no coarser one to be made.
void Sweep::find_references() {
  has_looked_ = true;
  is_needed_.assign(made_.size(), false);
  for (const std::size_t r : references_.compared()) is_needed_[r] = true;
  for (std::size_t r = made_.size(); r-- > 0;) {
    if (!is_needed_[r]) continue;
    made_[r] = store_.find(references_.recipes[r].id);
    const std::optional<std::size_t> coarser = references_.recipes[r].coarser;
    if (!made_[r] && coarser) is_needed_[*coarser] = true;
  }
}

/// The first reference that the next row needs. Those of later rows wait, so that the first are
/// there soon.
std::optional<std::size_t> Sweep::missing_reference() const {
  if (rows_.size() == n_settings()) return std::nullopt;
  const auto& [whole, own] = references_.of_setting[rows_.size()];
  for (const std::optional<std::size_t> needed :
       {references_.recipes[whole].coarser, std::optional(whole), own})
    if (needed && is_needed_[*needed] && !made_[*needed]) return needed;
  return std::nullopt;
}

void Sweep::make_reference(std::size_t index, double budget) {
  const ReferenceRecipe& recipe = references_.recipes[index];
  const Stopwatch watch;
  try {
    const Reference* coarser = recipe.coarser ? &*made_[*recipe.coarser] : nullptr;
    if (maker_ == nullptr) maker_ = make_reference_maker(recipe, times_, coarser);
    maker_->advance(budget);
  } catch (const InputError& error) {
    throw InputError("/scene" + error.where(), error.sentence());
  }
  seconds_at_hand_ += watch.elapsed();
  if (!maker_->done()) return;
  reference_seconds_[index] = std::exchange(seconds_at_hand_, 0);
  made_[index] = maker_->reference();
  PLEAT_CHECK(made_[index]->label.id == recipe.id, "a reference has the id of its recipe");
  const bool is_whole = made_[index]->samples.size() == times_.size();
  if (is_whole) store_.keep(*made_[index]);
  maker_.reset();
}

BenchRow Sweep::new_row(const Scene& scene) const {
  BenchRow row(made_[references_.of_setting[setting()].whole]->label);
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
  if (!run_->failed()) put_errors(row);
  row.warnings = run_->warnings();
  row.unbalanced_share = run_->unbalanced_share();
  row.process_peak_memory = process_peak_memory();
  return row;
}

/// The errors of the run at hand, which reached its end.
void Sweep::put_errors(BenchRow& row) const {
  const auto& [whole, own] = references_.of_setting[setting()];
  const Reference& reference = *made_[whole];
  compare(*run_, references_.recipes[whole].scene, reference, row);
  if (references_.recipes[whole].kind == ReferenceKind::same_mesh)
    row.method_error = row.position_error;
  if (!own) return;
  const Scene& scene = run_->simulation().scene();
  const Reference& same_mesh = *made_[*own];
  row.method_error =
      known_distance(scene, run_->samples(), same_mesh.samples, same_mesh.label.uncertainty);
  row.mesh_error =
      known_distance(scene, same_mesh.samples, reference.samples, reference.label.uncertainty);
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
    row.message = error.what();
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
  const Stopwatch watch;
  if (run_ == nullptr)
    if (std::optional<BenchRow> refused = begin_run()) return record_row(std::move(*refused));
  run_->advance(budget);
  if (run_->done()) {
    if (in_first_round()) {
      BenchRow row = measured_row();
      row_seconds_[setting()] = seconds_at_hand_ + watch.elapsed();
      record_row(std::move(row));
    } else {
      record_time(ms_per_frame(run_->timed_seconds(), run_->timed_duration()));
    }
    run_.reset();
  }
  seconds_at_hand_ = run_ != nullptr ? seconds_at_hand_ + watch.elapsed() : 0;
}

void Sweep::advance(double budget) {
  const Stopwatch watch;
  if (!has_looked_ && rows_.size() < n_settings()) find_references();
  while (!done()) {
    const double left = budget - watch.elapsed();
    if (const auto recipe = missing_reference())
      make_reference(*recipe, left);
    else
      work_on_run(left);
    skip_left_out();
    if (watch.elapsed() >= budget) break;
  }
  seconds_ += watch.elapsed();
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
    if (row.reference.id != references_.recipes[references_.of_setting[setting()].whole].id)
      return false;
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

/// References, first runs and timed runs with what is known of them.
std::vector<ExpectedWork> Sweep::works() const {
  std::vector<ExpectedWork> works;
  const std::optional<std::size_t> missing = missing_reference();
  const bool has_all_rows = rows_.size() == n_settings();
  const auto told_by = [&](double share) {
    return share > kTellingShare ? std::optional(seconds_at_hand_ / share) : std::nullopt;
  };
  for (std::size_t r = 0; r < made_.size(); ++r) {
    const Scene& scene = references_.recipes[r].scene;
    ExpectedWork work{"reference", expected_work(scene), 1};
    const bool is_at_hand = r == missing && maker_ != nullptr;
    const bool is_passed = made_[r] || has_all_rows || !is_needed_[r];
    work.n_passed = is_passed ? 1 : is_at_hand ? maker_->progress() : 0;
    work.seconds = is_at_hand ? told_by(work.n_passed) : reference_seconds_[r];
    works.push_back(std::move(work));
  }
  for (std::size_t s = 0; s < n_settings(); ++s) {
    const MethodOptions& method = plan_.settings[s].method;
    const double amount = expected_work(plan_.settings[s].n_vertices, method);
    const std::string kind = json_method(method).dump();
    const bool is_at_hand = s == setting() && run_ != nullptr;
    const double at_hand = is_at_hand ? run_->progress() : 0;
    const double n_passed = static_cast<double>(round() + (s < setting() ? 1 : 0)) + at_hand;
    const bool has_row = s < rows_.size();
    works.push_back(
        {kind, amount, 1, std::min(n_passed, 1.0), has_row ? row_seconds_[s] : told_by(at_hand)});
    if (has_row && !can_be_timed(rows_[s])) continue;  // its timed runs are left out
    ExpectedWork timed{"timed " + kind, amount, static_cast<double>(plan_.n_repeats),
                       std::max(n_passed - 1, 0.0)};
    if (has_row) timed.seconds = 1e-3 * rows_[s].ms_per_frame * plan_.duration / kFrame;
    works.push_back(std::move(timed));
  }
  return works;
}

std::optional<double> Sweep::estimated_seconds() const {
  const std::optional<double> rest = expected_rest(works());
  if (!rest) return std::nullopt;
  return seconds_ + *rest;
}

std::vector<std::string> Sweep::reference_ids() const {
  std::vector<std::string> ids;
  for (const std::size_t r : references_.compared()) ids.push_back(references_.recipes[r].id);
  return ids;
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
  const std::optional<double> estimated = estimated_seconds();
  return {{"done", done()},
          {"progress", progress()},
          {"estimated_s", estimated ? Json(*estimated) : Json(nullptr)},
          {"rows", rows},
          {"front", front_of(rows_)},
          {"message", message()}};
}

}  // namespace pleat
