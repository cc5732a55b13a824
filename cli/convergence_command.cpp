#include <cstdio>

#include "cli/command_table.h"
#include "cli/scene_input.h"
#include "core/base/core_version.h"
#include "core/dynamics/stepper_table.h"
#include "core/run/convergence_json.h"
#include "core/scene/format/method_section.h"

namespace pleat {
namespace {

constexpr int kMostRounds = 100000;
constexpr int kMostRepeats = 1000;

/// A section "method" as scenes have it, in a file of its own.
MethodOptions read_method_file(const std::string& file) {
  return with_source_named(Source{file}, [&] {
    const Json json = parse_json(read_file(file));
    return read_method(JsonReader(json), standard_steppers());
  });
}

std::vector<MethodOptions> take_methods(Arguments& arguments) {
  std::vector<std::string> words = arguments.list("--methods");
  if (words.empty()) words = {"pbd", "hpbd", "multigrid", "xpbd"};
  std::vector<MethodOptions> methods;
  for (const std::string& word : words) {
    const bool is_file = word.find(".json") != std::string::npos;
    const StepperType* const type = find_stepper(standard_steppers(), word);
    if (!is_file && type == nullptr)
      throw InputError("--methods", "expected steppers (" + stepper_names(standard_steppers()) +
                                        ") or JSON files with a method, got " + cut(word));
    methods.push_back(is_file ? read_method_file(word) : type->usual_method());
  }
  return methods;
}

ConvergenceOptions take_convergence_options(Arguments& arguments) {
  ConvergenceOptions options;
  options.time = arguments.number("--at", Numbers::not_negative).value_or(options.time);
  options.constraints =
      arguments.choice("--constraints", Constraints::rigid,
                       {{"rigid", Constraints::rigid}, {"compliant", Constraints::compliant}});
  options.diagonals = arguments.choice("--diagonals", Diagonals::one,
                                       {{"one", Diagonals::one}, {"both", Diagonals::both}});
  options.most_rounds =
      arguments.whole_number("--rounds", 1, kMostRounds).value_or(options.most_rounds);
  options.repeat = arguments.whole_number("--repeat", 1, kMostRepeats).value_or(options.repeat);
  options.methods = take_methods(arguments);
  return options;
}

void print_study(const SceneInput& input, const ConvergenceStudy& study) {
  std::printf("%s: the step of %.4g s at %.4g s; %d vertices, %d springs, %d bending elements\n",
              printable(input.scene.name).c_str(), study.step, study.time, study.n_vertices,
              study.n_springs, study.n_bends);
  for (const ConvergenceSeries& series : study.series) {
    std::printf("\n%s: %.3g mm from converged at first, known to %.1g mm\n",
                series.method.stepper->name, 1e3 * series.distance_begin,
                1e3 * series.distance_unknown);
    std::printf("rounds    sweeps        ms  relative error  distance\n");
    for (const ConvergencePoint& point : series.points)
      std::printf("%6d  %8.4g  %8.4g  %14.3g  %8.3g\n", point.rounds, point.sweeps, point.ms,
                  point.relative_error, point.relative_distance);
  }
}

Outcome convergence_command(Arguments arguments) {
  const bool for_machines = arguments.flag("--json");
  const ConvergenceOptions options = take_convergence_options(arguments);
  const SceneInput input = take_scene(arguments);
  if (options.time > input.scene.duration)
    throw InputError("--at", "expected a time within the scene's " +
                                 Json(input.scene.duration).dump() + " s, got " +
                                 Json(options.time).dump());
  const ConvergenceStudy study =
      with_source_named(input, [&] { return study_convergence(input.scene, options); });
  if (for_machines) {
    Json json = {{"scene", input.scene.name}};
    json.update(json_convergence(study));
    json["core"] = core_version();
    std::printf("%s\n", json.dump().c_str());
  } else {
    print_study(input, study);
  }
  return Outcome::ok;
}

}  // namespace

extern const Command kConvergenceCommand(
    "convergence", "SCENE.json", "error of one step after 1, 2, 3, 5, 9, ... rounds of each method",
    convergence_command, {kFabricHelp, kMethodHelp, kTimeHelp, kJsonHelp},
    R"(  --at S                 when the step begins (default 0); until then the scene's method runs
  --methods A,B,M.json   steppers, or files with a "method" (default: pbd,hpbd,multigrid,xpbd)
  --constraints rigid|compliant    of position-based methods (default: rigid)
  --diagonals one|both   of quads, as springs (default: one, as rigid ones contradict each other)
  --rounds N             at most (default 1025);  --repeat N  timed batches of each (default 1)
  All start from the same predicted places.
)");

}  // namespace pleat
