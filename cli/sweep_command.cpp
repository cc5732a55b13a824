#include <cstdio>
#include <memory>

#include "cli/commands.h"
#include "cli/progress.h"
#include "cli/reference_folder.h"
#include "cli/scene_input.h"
#include "core/scene/whole_file.h"
#include "core/base/check.h"
#include "core/measure/core_version.h"
#include "core/measure/sweep.h"
#include "core/scene/method_section.h"

namespace pleat {
namespace {

constexpr double kSlice = 0.1;  // [s] between reports of progress

constexpr StepperKind kSteppers[] = {StepperKind::explicit_euler, StepperKind::implicit_euler,
                                     StepperKind::projective, StepperKind::xpbd};

/// The settings of a stepper worth comparing, with step 1/60 s or the scene's own: each twice to
/// four times as dear as the one before.
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

std::vector<MethodOptions> take_methods(Arguments& arguments, const MethodOptions& scene_method) {
  std::vector<std::string> names = arguments.list("--steppers");
  if (names.empty())
    for (const StepperKind kind : kSteppers) names.emplace_back(name(kind));
  std::vector<MethodOptions> methods;
  for (const std::string& wanted : names) {
    const auto* known = std::find_if(std::begin(kSteppers), std::end(kSteppers),
                                     [&](StepperKind kind) { return wanted == name(kind); });
    if (known == std::end(kSteppers))
      throw InputError("--steppers",
                       "expected explicit, implicit, projective or xpbd, got \"" + wanted + "\"");
    for (const MethodOptions& method : usual_settings(*known, scene_method))
      methods.push_back(method);
  }
  return methods;
}

std::vector<int> take_levels(Arguments& arguments, const Scene& scene) {
  const int highest = std::holds_alternative<SheetShape>(scene.cloth) ? kMaxLevel : 0;
  std::vector<int> levels;
  for (const std::string& entry : arguments.list("--levels"))
    levels.push_back(parse_whole_number(entry, "--levels", 0, highest));
  if (levels.empty()) levels.push_back(scene.level);
  return levels;
}

ReferenceKind take_reference_kind(Arguments& arguments) {
  const std::string kind = arguments.text("--reference").value_or("finest");
  if (kind == "finest") return ReferenceKind::finest;
  if (kind == "rigid_chain") return ReferenceKind::rigid_chain;
  throw InputError("--reference", "expected finest or rigid_chain, got \"" + kind + "\"");
}

std::string json_lines(const std::vector<BenchRow>& rows) {
  std::string lines;
  for (const BenchRow& row : rows) lines += write_bench_row(row) + "\n";
  return lines;
}

void print_table(const Sweep& sweep) {
  const ReferenceLabel& reference = sweep.rows().front().reference;
  std::printf("%s, %.4g s; errors against %s: %s (%s)\n\n", sweep.plan().scene.name.c_str(),
              sweep.plan().duration, reference.id.c_str(), reference.description.c_str(),
              reference.converged ? "converged" : "not converged");
  std::fputs(markdown_table(sweep.rows()).c_str(), stdout);
}

}  // namespace

Outcome sweep_command(Arguments arguments) {
  const bool for_machines = arguments.flag("--json");
  const auto out = arguments.text("--out");
  const auto cache = arguments.text("--cache");
  const std::string commit = arguments.text("--commit").value_or(core_version());
  SweepPlan plan;
  plan.reference = take_reference_kind(arguments);
  plan.n_repeats = arguments.whole_number("--repeat", 1, 1000).value_or(plan.n_repeats);
  const SceneInput input = take_scene(arguments);
  plan.scene = input.scene;
  plan.duration = plan.scene.duration;
  plan.levels = take_levels(arguments, plan.scene);
  plan.methods = take_methods(arguments, plan.scene.method);
  arguments.finish();

  std::unique_ptr<ReferenceStore> store = std::make_unique<MemoryReferenceStore>();
  if (cache) store = std::make_unique<ReferenceFolder>(*cache);
  Sweep sweep(plan, *store, commit);
  {
    Progress progress;
    while (!sweep.done()) {
      with_file_named(input.file, [&] { sweep.advance(kSlice); });
      progress.show(sweep.progress(), sweep.message());
    }
  }
  if (out) write_file(*out, json_lines(sweep.rows()));
  if (for_machines)
    std::fputs(json_lines(sweep.rows()).c_str(), stdout);
  else
    print_table(sweep);
  for (const BenchRow& row : sweep.rows())
    if (!row.finished()) return Outcome::check_failed;
  return Outcome::ok;
}

}  // namespace pleat
