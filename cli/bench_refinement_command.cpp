#include <cstdio>
#include <numeric>

#include "cli/command_table.h"
#include "cli/plan_options.h"
#include "cli/progress.h"
#include "cli/scene_input.h"
#include "core/base/core_version.h"
#include "core/base/formatted.h"
#include "core/error/error_norms.h"
#include "core/error/restarts.h"
#include "core/error/side_by_side.h"
#include "core/files/plan_file.h"
#include "core/reference/reference.h"
#include "core/scene/format/method_section.h"
#include "core/sweep/bench_row.h"
#include "core/sweep/platform.h"

namespace pleat {
namespace {

/// The plans that are asked for, each with one demand or number of vertices.
std::vector<PlanOptions> take_plan_options(Arguments& arguments, const PlanOptions& usual) {
  std::vector<PlanOptions> all;
  for (const std::string& demand : arguments.list("--demand"))
    set_demand(all.emplace_back(usual), demand);
  for (const std::string& count : arguments.list("--vertices"))
    all.emplace_back(usual).max_vertices =
        parse_whole_number(count, "--vertices", 1, static_cast<int>(kMaxVertices));
  return all;
}

Json plans_json(const PlanMaker& maker, const std::vector<PlanOptions>& options) {
  Json plans = Json::array();
  for (const PlanOptions& wanted : options) {
    const Stopwatch watch;
    const RefinementPlan plan = maker.plan_for(wanted);
    plans.push_back({{"planning_s", watch.elapsed()}, {"plan", json_plan(plan)}});
  }
  return plans;
}

Outcome print_plans(const Scene& scene, const PlanRecipe& recipe,
                    const std::vector<PlanOptions>& options) {
  PlanMaker maker({scene}, recipe);
  finish(maker, scene.name);
  const PlanCost& cost = maker.cost();
  Json json = {{"scene", scene.name},
               {"n_fine_vertices", rest_cloth(scene).mesh.n_vertices()},
               {"example_s", cost.example_seconds},
               {"planning_s", cost.planning_seconds},
               {"kept_bytes", 1e6 * cost.megabytes},
               {"n_frames", cost.n_frames},
               {"frame_s", cost.frame_time},
               {"plans", plans_json(maker, options)},
               {"warnings", json_warnings(maker.warnings().front())},
               {"core", core_version()}};
  if (const auto memory = process_peak_memory()) json["process_peak_memory_bytes"] = *memory;
  std::printf("%s\n", json.dump().c_str());
  return Outcome::ok;
}

Json fit_json(const FitSummary& fit) {
  return {{"share_outside", fit.outside},
          {"worst_share", fit.last.worst_share},
          {"n_frames", fit.last.n_frames},
          {"first_fired", fit.last.first_fired ? Json(*fit.last.first_fired) : Json()}};
}

Json insides_json(const Insides& inside) {
  return {{"n_frames", inside.n_frames}, {"most", inside.most}, {"deepest_m", inside.deepest}};
}

/// A list for each ring, from kFewestFolds on.
Json folds_json(const Eigen::MatrixXd& amplitudes) {
  Json rings = Json::array();
  for (const auto& ring : amplitudes.colwise())
    rings.push_back(std::vector(ring.begin(), ring.end()));
  return rings;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// A frame's mean time is that of its dynamics, its contact and the change of its mesh.
Json row_json(const Contestant& contestant, const ContestantResult& result,
              const ReferenceLabel& against) {
  const Scene& scene = contestant.scene;
  const double contact = result.parts_ms[static_cast<std::size_t>(Part::contact)];
  const double refinement = result.refinement_ms.empty() ? 0 : mean(result.refinement_ms);
  Json json = {{"scene", scene.name},
               {"method", json_method(scene.method)},
               {"n_vertices", result.n_vertices},
               {"ms_per_frame", number_json(median(result.frame_ms))},
               {"dynamics_ms", number_json(mean(result.frame_ms) - contact - refinement)},
               {"contact_ms", contact},
               {"refinement_ms", refinement},
               {"n_timed_frames", result.frame_ms.size()},
               {"n_frames", result.n_frames},
               {"parts_ms", json_parts(result.parts_ms)},
               {"residual", result.report.relative_residual},
               {"errors",
                {{"position_m", number_json(result.errors.position)},
                 {"surface_m", number_json(result.errors.surface_rms)},
                 {"surface_95_m", number_json(result.errors.surface_95)},
                 {"bend_per_m", number_json(result.errors.bend_distribution)},
                 {"bend_over_time_per_m", number_json(result.bend_over_time)},
                 {"bend_of_regions_per_m", number_json(result.errors.bend_regions)},
                 {"sampling_m", number_json(result.sampling.distance)},
                 {"sampling_rad", number_json(result.sampling.normal_angle)}}},
               {"folds_m", folds_json(result.folds)},
               {"rms_stretch", result.rms_stretch},
               {"longest_edge", result.longest_edge},
               {"inside", insides_json(result.all_inside)},
               {"unpinned_inside", insides_json(result.unpinned_inside)},
               {"fit", result.fit ? fit_json(*result.fit) : Json()},
               {"split_curvature_per_m",
                contestant.adaptive ? Json(contestant.adaptive->split_curvature) : Json()},
               {"reference", json_label(against)},
               {"status", name(result.report.status)},
               {"message", result.report.message},
               {"target", build_target()}};
  return json;
}

/// Names the first run, against which all of a bench are held.
ReferenceLabel label_of_first(const Scene& scene, int n_vertices, const FrameOptions& options) {
  const double times[] = {options.begin, options.duration};
  return {
      reference_id("together", scene, times),
      scene.name + formatted(", %d vertices, its own run of %g s", n_vertices, options.duration)};
}

Outcome print_together(const std::vector<Contestant>& contestants, const FrameOptions& options) {
  SideBySide runs(contestants, options);
  {
    Progress progress;
    while (!runs.done()) {
      runs.advance();
      progress.show(runs.progress(), contestants.front().scene.name);
    }
  }
  const std::vector<ContestantResult> results = runs.results();
  const ReferenceLabel against =
      label_of_first(contestants.front().scene, results.front().n_vertices, options);
  Json rows = Json::array();
  Outcome outcome = Outcome::ok;
  for (std::size_t i = 0; i < results.size(); ++i) {
    rows.push_back(row_json(contestants[i], results[i], against));
    if (results[i].report.ends_run()) outcome = Outcome::check_failed;
  }
  Json json = {{"runs", rows},
               {"frame_s", options.frame_time},
               {"duration_s", options.duration},
               {"begin_s", options.begin},
               {"target", build_target()},
               {"core", core_version()}};
  if (const auto memory = process_peak_memory()) json["process_peak_memory_bytes"] = *memory;
  std::printf("%s\n", json.dump().c_str());
  return outcome;
}

Outcome print_restarts(const std::vector<SceneInput>& inputs, const RestartOptions& options) {
  std::vector<Scene> others;
  for (std::size_t k = 1; k < inputs.size(); ++k) others.push_back(inputs[k].scene);
  const auto errors = restart_errors(inputs.front().scene, others, options);
  Json rows = Json::array();
  for (std::size_t k = 0; k < others.size(); ++k) {
    Json of_run = Json::array();
    for (const double error : errors[k]) of_run.push_back(number_json(error));
    rows.push_back({{"scene", others[k].name},
                    {"n_vertices", rest_cloth(others[k]).mesh.n_vertices()},
                    {"errors_m", of_run}});
  }
  const Json json = {{"restarts", rows},
                     {"every_s", options.begin},
                     {"after_s", options.after},
                     {"duration_s", options.duration},
                     {"core", core_version()}};
  std::printf("%s\n", json.dump().c_str());
  return Outcome::ok;
}

Outcome bench_plans(Arguments arguments) {
  PlanRecipe recipe = take_plan_recipe(arguments);
  const std::vector<PlanOptions> options = take_plan_options(arguments, recipe.plan);
  const auto begin = arguments.number("--from");
  const SceneInput input = take_scene(arguments);
  if (options.empty()) throw InputError("--demand", "expected this or --vertices, got neither");
  recipe.plan = options.front();
  recipe.begin = begin.value_or(settled_time(input.scene));
  return with_source_named(input, [&] { return print_plans(input.scene, recipe, options); });
}

Outcome bench_together(Arguments arguments) {
  FrameOptions options;
  const auto begin = arguments.number("--from");
  const auto split_curvature = arguments.number("--adaptive");
  if (const auto n = arguments.whole_number("--every", 1, 1'000'000)) options.error_every = *n;
  const std::vector<SceneInput> inputs = take_scenes(arguments, arguments.list("--with"));
  const Scene& first = inputs.front().scene;
  options.duration = first.duration;
  options.begin = begin.value_or(first.duration / 2);
  options.settled = settled_time(first);
  std::vector<Contestant> contestants;
  contestants.reserve(inputs.size() + 1);
  for (const SceneInput& input : inputs) contestants.push_back({input.scene, {}});
  if (split_curvature)
    contestants.push_back({first, DynamicOptions{*split_curvature, first.level}});
  return with_source_named(inputs.front(), [&] { return print_together(contestants, options); });
}

Outcome bench_restarts(Arguments arguments) {
  RestartOptions options;
  options.begin = arguments.number("--every").value_or(options.begin);
  options.after = arguments.number("--after").value_or(options.after);
  const std::vector<SceneInput> inputs = take_scenes(arguments, arguments.list("--with"));
  options.duration = inputs.front().scene.duration;
  return with_source_named(inputs.front(), [&] { return print_restarts(inputs, options); });
}

}  // namespace

extern const Command kBenchPlans("plans", "SCENE.json",
                                 "plans that one example run leads to, and what they cost",
                                 bench_plans, {kFabricHelp, kMethodHelp, kTimeHelp},
                                 R"(  --demand X,Y --vertices N,M  a plan each
  --criterion C  --patterns N  --cap N  --from S    as of refine
)");

extern const Command kBenchTogether(
    "together", "SCENE.json", "runs of one cloth, frame of 1/30 s by frame in turn", bench_together,
    {kFabricHelp, kMethodHelp, kTimeHelp},
    R"(  --with A.json,B.json   the others, whose errors are against the first
  --adaptive K           one more, split anew in every frame where the first's base cloth bends more
                         than K [1/m]
  --from S               of what is timed and compared (default: half);  --every N  frames compared
)");

extern const Command kBenchRestarts(
    "restarts", "SCENE.json", "what meshes make wrong before chance does", bench_restarts,
    {kFabricHelp, kMethodHelp, kTimeHelp},
    R"(  --with A.json,B.json   the meshes, which start anew from the scene's state, sampled, and are held
                         against it a while later
  --every S              from one restart to the next (default 1)
  --after S              how long each runs (default 0.25)
)");

}  // namespace pleat
