#include "core/hard_cases/case_run.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/base/formatted.h"
#include "core/files/whole_file.h"
#include "core/scene/format/scene_file.h"

namespace pleat {
namespace {

/// Most work of a case's runs together, in forces of one vertex (StepperType::substep_cost): about
/// a second where a case is short, some ten where it is full.
constexpr double kBriefWork = 5e6;
constexpr double kFullWork = 1e8;

constexpr const char* kBadInput = "the input is bad";

/// A variant in motion and what watches it.
struct VariantRun {
  std::string label;
  Json json;  // its scene
  std::unique_ptr<Simulation> simulation;
  std::vector<std::unique_ptr<CaseMeasure>> measures;  // one per check
  VertexId in_hand;
};

Json case_scene(const HardCase& hard_case, const StepperType& type, CaseLength length,
                const CaseVariant& variant, const CaseFiles& files) {
  Json scene = parse_json(files.files(hard_case.name + ".json"));
  const StepperTable steppers = files.tables.steppers;
  override_scene(scene, std::array{SceneOverride{"/method/stepper", type.name}}, steppers);
  for (const StepperSetting& setting : hard_case.settings)
    if (setting.stepper == type.name) override_scene(scene, {&setting.change, 1}, steppers);
  if (length == CaseLength::brief) override_scene(scene, hard_case.brief_changes, steppers);
  override_scene(scene, variant.changes, steppers);
  return scene;
}

std::unique_ptr<Simulation> simulation_of(const Json& scene, const CaseFiles& files) {
  return std::make_unique<Simulation>(
      read_scene(JsonReader(scene), files.fabrics, files.files, files.tables));
}

VariantRun begun(const HardCase& hard_case, const StepperType& type, CaseLength length,
                 const CaseVariant& variant, const CaseFiles& files) {
  VariantRun run;
  run.label = variant.label;
  run.json = case_scene(hard_case, type, length, variant, files);
  run.simulation = simulation_of(run.json, files);
  if (hard_case.start != nullptr)
    run.simulation->start_from(hard_case.start(run.simulation->rest_positions()));
  return run;
}

double step_of(const VariantRun& run) { return run.simulation->scene().method.step; }

/// Work for a second of a run.
double work_rate(const VariantRun& run) {
  const MethodOptions& method = run.simulation->scene().method;
  return method.stepper->substep_cost(method) * run.simulation->substeps() *
         run.simulation->model().n_vertices() / method.step;
}

/// How long the runs may last [s].
double affordable(const std::vector<VariantRun>& runs, double asked, CaseLength length) {
  double rate = 0;
  double longest_step = 0;
  for (const VariantRun& run : runs) {
    rate += work_rate(run);
    longest_step = std::max(longest_step, step_of(run));
  }
  const double most = (length == CaseLength::brief ? kBriefWork : kFullWork) / rate;
  if (most >= asked) return asked;
  return std::max(1.0, std::floor(most / longest_step)) * longest_step;
}

/// Does what an event says to a run.
struct EventHandler {
  VariantRun& run;
  const CaseFiles& files;

  Simulation& simulation() const { return *run.simulation; }
  void operator()(const HandGrabs& hand) const {
    run.in_hand = hand.vertex;
    simulation().grab(hand.vertex);
  }
  void operator()(const HandMoves& hand) const {
    simulation().move_grab(simulation().state().positions.col(run.in_hand) + hand.offset);
  }
  void operator()(const HandLetsGo&) const { simulation().release_grab(); }
  void operator()(const SceneSwitch& scene) const {
    override_scene(run.json, scene.changes, files.tables.steppers);
    auto next = simulation_of(run.json, files);
    next->carry_over(simulation());
    run.simulation = std::move(next);
  }
};

/// Starts those checks that say something of a run, with what they saw at its start.
void begin_checks(const HardCase& hard_case, double duration, VariantRun& run) {
  for (const CaseCheck& check : hard_case.checks) {
    run.measures.push_back(check.measure(*run.simulation, duration));
    run.measures.back()->update(*run.simulation, {});
  }
}

/// Runs to the end, or until the numbers end it; then its report says so.
SolveReport run_variant(const HardCase& hard_case, double duration, const CaseFiles& files,
                        const CaseProgress& progress, VariantRun& run) {
  const double step = step_of(run);
  const std::int64_t n_steps = whole_steps(duration, step);
  auto event = hard_case.events.begin();
  for (std::int64_t s = 0; s < n_steps; ++s) {
    const double time = static_cast<double>(s) * step;
    for (; event != hard_case.events.end() && event->time <= time + step / 2; ++event)
      std::visit(EventHandler{run, files}, event->what);
    SolveReport report = run.simulation->step();
    if (report.ends_run()) return report;
    for (const auto& measure : run.measures) measure->update(*run.simulation, report);
    if (progress) progress(static_cast<double>(s + 1) / static_cast<double>(n_steps));
  }
  return {};
}

std::string labelled(const std::string& what, const std::string& label) {
  return label.empty() ? what : label + ": " + what;
}

/// Null where the stepper has to keep the check as it is.
const CaseException* exception_of(const HardCase& hard_case, const std::string& stepper,
                                  const std::string& check) {
  const auto at = std::find_if(
      hard_case.exceptions.begin(), hard_case.exceptions.end(),
      [&](const CaseException& e) { return e.stepper == stepper && e.check == check; });
  return at == hard_case.exceptions.end() ? nullptr : &*at;
}

/// Bound of a check for the stepper; nothing where it is not asked.
template <class Check>
std::optional<double> bound_of(const HardCase& hard_case, const Check& check,
                               const CaseOutcome& outcome) {
  if (check.needs_whole_run && outcome.reached < outcome.asked) return std::nullopt;
  const CaseException* exception = exception_of(hard_case, outcome.stepper, check.what);
  return exception == nullptr ? std::optional(check.bound) : exception->bound;
}

std::string sentence(const CaseFinding& finding) {
  return finding.what + ": expected at most " + three_digits(finding.bound) + ", got " +
         three_digits(finding.found) + (finding.detail.empty() ? "" : " (" + finding.detail + ")");
}

void judge(std::vector<CaseFinding> findings, CaseOutcome& outcome) {
  outcome.findings = std::move(findings);
  for (const CaseFinding& finding : outcome.findings) {
    if (finding.is_kept()) continue;
    outcome.status = CaseStatus::failed;
    outcome.sentence += (outcome.sentence.empty() ? "" : "; ") + sentence(finding);
  }
}

/// Findings of the checks that the runs have to keep.
std::vector<CaseFinding> findings_of(const HardCase& hard_case, std::vector<VariantRun>& runs,
                                     const CaseOutcome& outcome) {
  std::vector<CaseFinding> findings;
  for (const VariantRun& run : runs)
    for (std::size_t c = 0; c < hard_case.checks.size(); ++c) {
      const CaseCheck& check = hard_case.checks[c];
      if (const auto bound = bound_of(hard_case, check, outcome))
        findings.push_back({labelled(check.what, run.label), run.measures[c]->value(), *bound,
                            run.measures[c]->detail()});
    }
  std::vector<std::unique_ptr<Simulation>> ends;
  ends.reserve(runs.size());
  for (VariantRun& run : runs) ends.push_back(std::move(run.simulation));
  for (const VariantCheck& check : hard_case.variant_checks)
    if (const auto bound = bound_of(hard_case, check, outcome))
      findings.push_back({check.what, check.difference(ends), *bound});
  return findings;
}

/// Why it is right that this input is refused; empty where it is not.
std::string excuse_for_refusal(const HardCase& hard_case, const StepperType& type,
                               const InputError& error) {
  if (hard_case.is_bad_input) return kBadInput;
  if (type.needs_springs && error.where() == "/model")
    return "it works on springs with quadratic bending alone";
  if (type.has_stability_bound && error.where() == "/method/substeps")
    return "it has no stable substep that could be afforded, and says so before it begins";
  return "";
}

std::string excuse_for_stop(const HardCase& hard_case, const std::string& stepper) {
  for (const AllowedStop& stop : hard_case.stops)
    if (stop.stepper == stepper) return stop.reason;
  return "";
}

void refuse(const InputError& error, std::string excuse, CaseOutcome& outcome) {
  outcome.status = CaseStatus::refused;
  outcome.sentence = labelled(error.sentence(), error.where());
  outcome.excuse = std::move(excuse);
}

/// Fails bad input that was not refused.
void fail_as_accepted(CaseOutcome& outcome) {
  outcome.status = CaseStatus::failed;
  outcome.sentence = "expected to be refused as bad input, and was not";
}

}  // namespace

CaseOutcome run_case(const HardCase& hard_case, const StepperType& type, CaseLength length,
                     const CaseFiles& files, const CaseProgress& progress) {
  CaseOutcome outcome{.case_name = hard_case.name, .stepper = type.name};
  outcome.asked = length == CaseLength::brief ? hard_case.seconds.brief : hard_case.seconds.full;
  std::vector<VariantRun> runs;
  try {
    for (const CaseVariant& variant : hard_case.variants)
      runs.push_back(begun(hard_case, type, length, variant, files));
  } catch (const FileError&) {
    throw;
  } catch (const InputError& error) {
    refuse(error, excuse_for_refusal(hard_case, type, error), outcome);
    return outcome;
  }
  if (hard_case.is_bad_input) {
    fail_as_accepted(outcome);
    return outcome;
  }
  outcome.reached = affordable(runs, outcome.asked, length);
  for (VariantRun& run : runs) {
    begin_checks(hard_case, outcome.reached, run);
    const SolveReport report = run_variant(hard_case, outcome.reached, files, progress, run);
    if (!report.ends_run()) continue;
    outcome.status = CaseStatus::stopped;
    outcome.sentence = labelled(report.message, run.label);
    outcome.excuse = excuse_for_stop(hard_case, type.name);
    outcome.reached = run.simulation->time();
    return outcome;
  }
  judge(findings_of(hard_case, runs, outcome), outcome);
  return outcome;
}

CaseOutcome do_case(const HardCase& hard_case, const CaseFiles& files) {
  PLEAT_CHECK(hard_case.still, "a case without a stepper says what is done");
  CaseOutcome outcome{.case_name = hard_case.name};
  try {
    judge(hard_case.still(files), outcome);
    if (hard_case.is_bad_input) fail_as_accepted(outcome);
  } catch (const FileError&) {
    throw;
  } catch (const InputError& error) {
    refuse(error, hard_case.is_bad_input ? kBadInput : "", outcome);
  }
  return outcome;
}

}  // namespace pleat
