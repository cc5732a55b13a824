#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "cli/commands.h"
#include "cli/progress.h"
#include "cli/reference_folder.h"
#include "cli/scene_input.h"
#include "core/base/check.h"
#include "core/measure/core_version.h"
#include "core/measure/sweep.h"
#include "core/scene/cloth_section.h"
#include "core/scene/method_section.h"
#include "core/scene/whole_file.h"

namespace pleat {
namespace {

constexpr double kSlice = 0.1;  // [s] between reports of progress

constexpr StepperKind kSteppers[] = {StepperKind::explicit_euler, StepperKind::implicit_euler,
                                     StepperKind::projective, StepperKind::xpbd};

/// The settings of a stepper worth comparing, with the scene's own step: each about three times as
/// dear as the one before.
std::vector<MethodOptions> usual_settings(StepperKind stepper, const MethodOptions& scene_method) {
  MethodOptions method = scene_method;
  method.stepper = stepper;
  method.iterations = 1;
  std::vector<int> substeps;
  switch (stepper) {
    case StepperKind::explicit_euler:
      substeps = {0};
      break;
    case StepperKind::implicit_euler:
      substeps = {1, 4};
      break;
    case StepperKind::projective:
      method.solver = best_direct_solver();
      method.iterations = 5;
      substeps = {1, 4};
      break;
    case StepperKind::xpbd:
      substeps = {10, 30, 100};
      break;
  }
  std::vector<MethodOptions> settings;
  for (const int n : substeps) {
    settings.push_back(method);
    settings.back().substeps = n;
  }
  return settings;
}

std::vector<MethodOptions> plan_methods(std::vector<std::string> names,
                                        const MethodOptions& scene_method) {
  if (names.empty())
    for (const StepperKind kind : kSteppers) names.emplace_back(name(kind));
  std::vector<MethodOptions> methods;
  for (auto name_at = names.begin(); name_at != names.end(); ++name_at) {
    const std::string& wanted = *name_at;
    if (std::find(names.begin(), name_at, wanted) != name_at)
      throw InputError("--steppers", "expected each stepper once, got " + wanted + " twice");
    const auto* known = std::find_if(std::begin(kSteppers), std::end(kSteppers),
                                     [&](StepperKind kind) { return wanted == name(kind); });
    if (known == std::end(kSteppers))
      throw InputError("--steppers", "expected explicit, implicit, projective or xpbd, got " +
                                         abbreviated(Json(wanted)));
    for (const MethodOptions& method : usual_settings(*known, scene_method))
      methods.push_back(method);
  }
  return methods;
}

std::vector<int> plan_levels(const std::vector<std::string>& entries, const Scene& scene) {
  std::vector<int> levels;
  for (const std::string& entry : entries) {
    const int level = parse_whole_number(entry, "--levels", 0, kMaxLevel);
    check_level(scene, level, "--levels");
    if (std::find(levels.begin(), levels.end(), level) != levels.end())
      throw InputError("--levels",
                       "expected each level once, got " + std::to_string(level) + " twice");
    levels.push_back(level);
  }
  if (levels.empty()) levels.push_back(scene.level);
  return levels;
}

ReferenceKind take_reference_kind(Arguments& arguments) {
  const std::string kind = arguments.text("--reference").value_or("finest");
  if (kind == "finest") return ReferenceKind::finest;
  if (kind == "rigid_chain") return ReferenceKind::rigid_chain;
  throw InputError("--reference", "expected finest or rigid_chain, got " + abbreviated(Json(kind)));
}

std::string json_lines(const std::vector<BenchRow>& rows) {
  std::string lines;
  for (const BenchRow& row : rows) lines += write_bench_row(row) + "\n";
  return lines;
}

void print_table(const Sweep& sweep) {
  const ReferenceLabel& reference = sweep.rows().front().reference;
  std::printf("%s, %.4g s; errors against %s: %s (%s)\n\n",
              printable(sweep.plan().scene.name).c_str(), sweep.plan().duration,
              reference.id.c_str(), reference.description.c_str(),
              reference.converged ? "converged" : "not converged");
  std::fputs(markdown_table(sweep.rows()).c_str(), stdout);
}

/// Says on stderr when there was nothing to compare with.
Outcome judged(const std::vector<BenchRow>& rows) {
  const auto lacks_error = [](const BenchRow& row) {
    return row.finished() && !std::isfinite(row.position_error);
  };
  const auto unmeasured = std::find_if(rows.begin(), rows.end(), lacks_error);
  if (unmeasured != rows.end())
    std::fprintf(stderr, "pleat: no errors, as the reference is %s\n",
                 unmeasured->reference.description.c_str());
  const bool all_finished =
      std::all_of(rows.begin(), rows.end(), [](const BenchRow& row) { return row.finished(); });
  return all_finished && unmeasured == rows.end() ? Outcome::ok : Outcome::check_failed;
}

}  // namespace

Outcome sweep_command(Arguments arguments) {
  const bool for_machines = arguments.flag("--json");
  const auto out = arguments.text("--out");
  const auto cache = arguments.text("--cache");
  const std::string commit = arguments.text("--commit").value_or(core_version());
  const std::vector<std::string> levels = arguments.list("--levels");
  const std::vector<std::string> steppers = arguments.list("--steppers");
  SweepPlan plan;
  plan.reference = take_reference_kind(arguments);
  plan.n_repeats = arguments.whole_number("--repeat", 1, 1000).value_or(plan.n_repeats);
  arguments.refuse("--level", "a sweep does not take this option, but --levels");
  for (const char* option : {"--stepper", "--substeps", "--iterations"})
    arguments.refuse(option, "a sweep does not take this option, but --steppers");
  SceneInput input = take_scene(arguments);
  arguments.finish();
  plan.scene = input.scene;
  plan.duration = plan.scene.duration;
  plan.levels = plan_levels(levels, plan.scene);
  plan.methods = plan_methods(steppers, plan.scene.method);
  with_source_named(input, [&] { check_duration(plan); });
  input.scene = finest_scene(plan);  // the most memory

  if (out) check_writable(*out);
  std::unique_ptr<ReferenceStore> store = std::make_unique<MemoryReferenceStore>();
  if (cache) store = std::make_unique<ReferenceFolder>(*cache);
  Sweep sweep(plan, *store, commit);
  {
    Progress progress;
    while (!sweep.done()) {
      with_source_named(input, [&] { sweep.advance(kSlice); });
      progress.show(sweep.progress(), sweep.message());
    }
  }
  if (for_machines)
    std::fputs(json_lines(sweep.rows()).c_str(), stdout);
  else
    print_table(sweep);
  if (out) write_file(*out, json_lines(sweep.rows()));
  return judged(sweep.rows());
}

}  // namespace pleat
